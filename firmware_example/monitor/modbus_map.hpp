// The coils and registers of the monitor. The folder's README has them as a table.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "monitor/alarms.hpp"
#include "monitor/estimator_alarm.hpp"
#include "monitor/frame.hpp"
#include "monitor/modbus_server.hpp"
#include "monitor/refusal.hpp"
#include "monitor/settings.hpp"
#include "taut/scene/path.hpp"

namespace monitor {

/// One more whenever the map changes.
constexpr std::uint16_t modbus_map_version = 1;

/// Addresses as they are on the line, from zero. Numbers of 32 bits take two registers, the high one first.
namespace modbus {

// Input registers.
constexpr int status = 0, findings = 100;
constexpr int tension = 1000, deviation = 2000, mu = 3000, mu_deviation = 4000, slip = 5000, contact = 6000,
              friction = 7000, extension = 8000, strut = 9000, state = 10000;
constexpr int block = 1000;

// Holding registers.
constexpr int sequence = 0, time_step = 2, least = 4, most = 6, frozen_after = 8, scene = 10, numbers = 100;

// Coils.
constexpr int take_sample = 0, acknowledge = 1, choose_scene = 2, set_limits = 3, restart = 4, lock = 100,
              zero = 1100;

}  // namespace modbus

/// What ModbusServer serves, of an Application. Holds the numbers of the next sample.
template <class Application>
class ModbusMap {
 public:
  explicit ModbusMap(Application& application) : application_(application) { forget(); }

  void begin_reading() {
    application_.visit([](auto& session) {
      if (session.usable()) session.respond();
    });
  }

  /// The alarms that were not acknowledged, then whether the forces are good.
  bool discrete(std::uint16_t address, bool& value) {
    if (address < alarm_count) {
      value = Alarms(application_.common().latched).has(static_cast<Alarm>(address));
      return true;
    }
    if (address != 16) return false;
    application_.visit([&](auto& session) { value = session.outcome().quality == Quality::good; });
    return true;
  }

  bool coil(std::uint16_t address, bool& value) {
    value = false;
    if (address <= modbus::restart) return true;
    bool found = false;
    application_.visit([&](auto& session) {
      const auto [cable, end, is_lock] = end_at(address);
      const auto* const cell = address < modbus::lock ? nullptr : session.cell(cable, end);
      if (cell == nullptr) return;
      found = !is_lock || session.is_jacked(cable, end);
      value = is_lock && cell->locked;
    });
    return found;
  }
  ModbusException set_coil(std::uint16_t address, bool value) {
    if (address >= modbus::lock) {
      const auto [cable, end, is_lock] = end_at(address);
      if (is_lock) return exception_of(application_.lock(cable, end, value));
      return value ? exception_of(application_.zero(cable, end)) : ModbusException::none;
    }
    if (!value) return ModbusException::none;
    switch (address) {
      case modbus::take_sample:
        return take_sample();
      case modbus::acknowledge:
        application_.acknowledge_alarms();
        return ModbusException::none;
      case modbus::choose_scene:
        forget();
        return exception_of(application_.choose_scene(next_.scene));
      case modbus::set_limits:
        return exception_of(
            application_.set_limits({float_of(next_.limits[0]), float_of(next_.limits[1]), next_.limits[2]}));
      default:
        restarts_ = true;
        return ModbusException::none;
    }
  }
  /// Whether a restart was asked for, once: it is for after the answer.
  bool take_restart() {
    const bool restarts = restarts_;
    restarts_ = false;
    return restarts;
  }

  bool holding(std::uint16_t address, std::uint16_t& value) {
    if (address == modbus::scene) {
      value = next_.scene;
      return true;
    }
    const std::uint32_t* const number = holding_number(address);
    if (number == nullptr) return false;
    value = half_of(*number, address);
    return true;
  }
  void set_holding(std::uint16_t address, std::uint16_t value) {
    if (address == modbus::scene) {
      next_.scene = value;
      return;
    }
    std::uint32_t* const number = holding_number(address);
    if (number == nullptr) return;
    *number = address % 2 == 0 ? (*number & 0x0000FFFFU) | static_cast<std::uint32_t>(value) << 16U
                               : (*number & 0xFFFF0000U) | value;
  }

  bool input(std::uint16_t address, std::uint16_t& value) {
    bool found = false;
    application_.visit([&](auto& session) {
      const int at = address;
      std::uint32_t number = 0;
      if (at < modbus::findings) {
        found = is_status_number(at) ? status_number(session, at - at % 2, number)
                                     : status_word(session, at, value);
        if (found && is_status_number(at)) value = half_of(number, address);
      } else if (at >= modbus::state) {
        found = session.usable() && at - modbus::state < session.model().joints;
        if (found) value = static_cast<std::uint16_t>(session.response().state[at - modbus::state]);
      } else {
        found =
            session.usable() && (at < modbus::tension ? finding(session, (at - modbus::findings) / 2, number)
                                                      : answer(session, at, number));
        value = half_of(number, address);
      }
    });
    return found;
  }

  /// Frames whose checksum was wrong, for the register that says so.
  void count_bad_frame() { ++bad_frames_; }

 private:
  /// The bits that stand for no reading. Any other NaN does, too.
  static constexpr std::uint32_t no_reading = 0x7FC00000;

  /// What is written down until a command takes it.
  struct Next {
    std::uint32_t sequence = 1, time_step = 0x3F800000;
    std::uint32_t limits[3] = {bits_of(CellLimits().least), bits_of(CellLimits().most),
                               CellLimits().frozen_after};
    std::uint16_t scene = 0;
    std::uint32_t numbers[Application::most_numbers] = {};
  };
  struct End {
    std::uint32_t cable, end;
    bool is_lock;
  };

  /// Walks over the numbers of the next sample as Fields walks over those of a frame.
  class Numbers {
   public:
    explicit Numbers(const Next& next) : next_(next) {}
    bool real(float& value) {
      value = float_of(at_ < 0 ? next_.time_step : next_.numbers[at_]);
      ++at_;
      return true;
    }
    bool reading(bool& has, float& value) {
      real(value);
      has = !std::isnan(value);
      if (!has) value = 0;
      return true;
    }
    static bool done() { return true; }

   private:
    const Next& next_;
    int at_ = -1;
  };

  static std::uint16_t half_of(std::uint32_t number, int address) {
    return static_cast<std::uint16_t>(address % 2 == 0 ? number >> 16U : number & 0xFFFFU);
  }
  static End end_at(int address) {
    const bool is_lock = address < modbus::zero;
    const auto place = static_cast<std::uint32_t>(address - (is_lock ? modbus::lock : modbus::zero));
    return {place / 2, place % 2, is_lock};
  }
  static ModbusException exception_of(Refusal refusal) {
    switch (refusal) {
      case Refusal::none:
        return ModbusException::none;
      case Refusal::zero:
      case Refusal::no_scene:
        return ModbusException::device_failure;
      case Refusal::cell:
        return ModbusException::illegal_address;
      default:
        return ModbusException::illegal_value;
    }
  }

  void forget() {
    for (std::uint32_t& number : next_.numbers) number = no_reading;
  }
  ModbusException take_sample() {
    const Refusal refusal = application_.take_sample(next_.sequence, [this](auto& session) {
      Numbers numbers(next_);
      return session.read(numbers);
    });
    if (refusal != Refusal::none) return exception_of(refusal);
    // What is not written again is not a reading of the next sample.
    application_.visit([this](auto& session) {
      for (int i = session.model().loads; i < session.count_numbers(); ++i) next_.numbers[i] = no_reading;
    });
    return ModbusException::none;
  }

  /// Null if there is none.
  std::uint32_t* holding_number(int address) {
    switch (address / 2 * 2) {
      case modbus::sequence:
        return &next_.sequence;
      case modbus::time_step:
        return &next_.time_step;
      case modbus::least:
        return &next_.limits[0];
      case modbus::most:
        return &next_.limits[1];
      case modbus::frozen_after:
        return &next_.limits[2];
      default:
        break;
    }
    if (address < modbus::numbers) return nullptr;
    const int i = (address - modbus::numbers) / 2;
    int count = 0;
    application_.visit([&](auto& session) { count = session.usable() ? session.count_numbers() : 0; });
    return i < count ? &next_.numbers[i] : nullptr;
  }

  // Of the status, registers of their own and numbers in pairs.

  static constexpr int first_status_number = 20, end_of_status = 38;
  static bool is_status_number(int at) { return at >= first_status_number; }
  template <class Session>
  bool status_word(Session& session, int at, std::uint16_t& value) const {
    const auto& outcome = session.outcome();
    const bool usable = session.usable();
    int number = 0;
    switch (at) {
      case 0:
        number = modbus_map_version;
        break;
      case 1:
        number = worth(outcome.quality);
        break;
      case 2:
        number = application_.scene();
        break;
      case 3:
        number = Application::scenes;
        break;
      case 4:
        number = usable ? session.model().cables.size() : 0;
        break;
      case 5:
        number = usable ? session.model().segments : 0;
        break;
      case 6:
        number = usable ? session.model().joints : 0;
        break;
      case 7:
        number = usable ? session.model().loads : 0;
        break;
      case 8:
        number = usable ? session.strut_count() : 0;
        break;
      case 9:
        if (usable) session.for_each_finding([&](const auto&) { ++number; });
        break;
      case 10:
        number = static_cast<int>(outcome.status.code);
        break;
      case 11:
        number = static_cast<int>(outcome.status.place);
        break;
      case 12:
        number = outcome.status.index;
        break;
      case 13:
        number = outcome.status.cable;
        break;
      case 14:
        number = outcome.events < 0xFFFF ? outcome.events : 0xFFFF;
        break;
      case 15:
        number = application_.common().has_last != 0 ? 1 : 0;
        break;
      default:
        return false;
    }
    value = static_cast<std::uint16_t>(number);
    return true;
  }
  template <class Session>
  bool status_number(Session& session, int at, std::uint32_t& number) const {
    switch (at) {
      case 20:
        number = application_.common().last;
        return true;
      case 22:
        number = application_.common().latched;
        return true;
      case 24:
        number = bits_of(session.outcome().fraction);
        return true;
      case 26:
        number = session.maker();
        return true;
      case 28:
        number = bad_frames_;
        return true;
      case 30:
        number = application_.board().lost_bytes();
        return true;
      case 32:
        number = application_.common().restarts;
        return true;
      case 34:
        number = static_cast<std::uint32_t>(application_.board().start());
        return true;
      case 36:
        number = application_.board().milliseconds();
        return true;
      default:
        return false;
    }
  }
  static int worth(Quality quality) {
    switch (quality) {
      case Quality::good:
        return 4;
      case Quality::doubtful:
        return 3;
      case Quality::behind:
        return 2;
      case Quality::held:
        return 1;
      default:
        return 0;
    }
  }

  template <class Session>
  static bool finding(Session& session, int wanted, std::uint32_t& number) {
    int i = 0;
    session.for_each_finding([&](const auto& each) {
      if (i++ == wanted) number = code_of(each);
    });
    return wanted < i;
  }
  template <class Session>
  static bool answer(Session& session, int at, std::uint32_t& number) {
    using Cap = typename Session::Cap;
    static_assert(Cap::segments <= modbus::block / 2 && Cap::joints <= modbus::block / 2 &&
                      Cap::struts <= modbus::block / 2 && Cap::cables <= modbus::block / 4,
                  "a block of the map is too small for the scene");
    const int i = at % modbus::block / 2;
    const int segments = session.model().segments, joints = session.model().joints;
    const auto& response = session.response();
    const auto give = [&](int count, auto value) {
      if (i < count) number = bits_of(value(i));
      return i < count;
    };
    switch (at - at % modbus::block) {
      case modbus::tension:
        return give(segments, [&](int k) { return response.tension[k]; });
      case modbus::deviation:
        return give(segments, [&](int k) { return session.deviation(k); });
      case modbus::mu:
        return give(joints, [&](int k) { return session.mu(k); });
      case modbus::mu_deviation:
        return give(joints, [&](int k) { return session.mu_deviation(k); });
      case modbus::slip:
        return give(joints, [&](int k) { return response.slip[k]; });
      case modbus::contact:
        return give(joints, [&](int k) { return response.contact[k]; });
      case modbus::friction:
        return give(joints, [&](int k) { return response.friction[k]; });
      case modbus::extension: {
        int jacks = 0;
        float extension = 0;
        taut::for_each_jacked_end(session.model().cables, [&](int c, std::size_t end) {
          if (jacks++ == i) extension = response.extension[c][end];
        });
        return give(jacks, [&](int) { return extension; });
      }
      default:
        return give(session.strut_count(), [&](int k) { return response.strut[k]; });
    }
  }

  Application& application_;
  Next next_;
  std::uint32_t bad_frames_ = 0;
  bool restarts_ = false;
};

}  // namespace monitor
