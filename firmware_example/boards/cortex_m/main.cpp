// The monitor on a Cortex-M.
#include "board.hpp"
#include "boards/cortex_m/run.hpp"
#include "monitor/scenes.hpp"

void run() {
  static boards::Board board;
  static monitor::Monitor<boards::Board> application(board);
  application.begin();
  for (;;) {
    application.step();
    board.idle();
  }
}
