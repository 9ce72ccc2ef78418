// The monitor on an STM32F405: frames on USART1, Modbus on USART2.
#include "board.hpp"
#include "boards/cortex_m/run.hpp"
#include "monitor/modbus_slave.hpp"
#include "monitor/scenes.hpp"

#ifndef MODBUS_BAUD
#define MODBUS_BAUD monitor::Settings::modbus_baud
#endif

void run() {
  using Application = monitor::Monitor<boards::Board>;
  constexpr std::uint32_t baud = MODBUS_BAUD;
  static boards::Board board(baud);
  static Application application(board);
  static monitor::ModbusSlave<Application, boards::ModbusLine> modbus(
      application, board.modbus(), monitor::Settings::modbus_address, baud);
  application.begin();
  for (;;) {
    application.step();
    modbus.step();
    board.idle();
  }
}
