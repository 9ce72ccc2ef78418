// What the start-up code calls when memory is in order; C++ forbids calling main().
#pragma once

extern "C" void run();
