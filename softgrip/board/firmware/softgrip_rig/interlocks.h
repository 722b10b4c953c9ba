// What stops the motor whatever the host wants.
#pragma once
#include <stdint.h>

namespace interlocks {
void heard();          // a valid frame came
void begin_anew();     // with the search for a stuck sensor, as when the position is set
void estop();
uint8_t clear();       // a Reason, or 0
bool may_move();
bool may_push();       // apart from homing, which motion.h minds
void tick();           // once a pressure sample
}
