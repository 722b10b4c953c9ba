#include "interlocks.h"

#include <avr/io.h>

#include "converter.h"
#include "motion.h"
#include "pins.h"
#include "state.h"
#include "stepper.h"

namespace interlocks {

static uint32_t last_heard;
static uint8_t out_of_range, over, pressed;  // samples in a row: one alone may be a spark
static uint16_t seen;   // pressure at which the sensor was last known to live
static int32_t seen_at; // and the place of the plunger then

const uint8_t IN_A_ROW = 2;

static bool twice(bool is, uint8_t& count) {
  count = !is ? 0 : count < IN_A_ROW ? count + 1 : count;
  return count == IN_A_ROW;
}

void heard() {
  last_heard = converter::now();
  set(Flag_HOST_SILENT, false);
}

void begin_anew() { seen_at = stepper::position(); }

void estop() {
  set(Flag_ESTOPPED, true);
  motion::halt();
}

uint8_t clear() {
  if (out_of_range) return Reason_STILL_FAULTY;
  set(Flag_ESTOPPED | Flag_SENSOR_RANGE | Flag_SENSOR_STUCK | Flag_SWITCH_FAULT, false);
  begin_anew();
  return 0;
}

bool may_move() { return HAS_PUMP && has(Flag_GREETED) && !has(Flag_ESTOPPED | Flag_HOST_SILENT); }

bool may_push() { return !has(Flag_OVER_PRESSURE | Flag_SENSOR_RANGE | Flag_SENSOR_STUCK); }

static void check_pressure() {
  uint16_t now = converter::count(CHANNEL_PRESSURE);
  if (twice(now < PRESSURE_LOW || now > PRESSURE_HIGH, out_of_range)) {
    set(Flag_SENSOR_RANGE, true);
  }
  if (twice(now >= limits.pressure, over)) {
    set(Flag_OVER_PRESSURE, true);
  } else if (now + PRESSURE_RELEASE < limits.pressure) {
    set(Flag_OVER_PRESSURE, false);
  }
  int32_t place = stepper::position();
  uint16_t change = now > seen ? now - seen : seen - now;
  if (change >= STUCK_COUNTS || place < seen_at) {
    seen = now;
    seen_at = place;
  } else if (place - seen_at >= STUCK_STEPS) {
    set(Flag_SENSOR_STUCK, true);
  }
}

static void check_switch() {
  bool high = PINH & SWITCH;
  set(Flag_HOME_SWITCH, high);
  bool sure = twice(high, pressed);
  if (sure && has(Flag_HOMED) && stepper::position() > SWITCH_STEPS) {
    // Pressed where it cannot be: the position is wrong, or the wire is broken.
    set(Flag_SWITCH_FAULT, true);
    set(Flag_HOMED, false);
    motion::halt();
  }
}

void tick() {
  if (converter::now() - last_heard >= limits.silence) set(Flag_HOST_SILENT, true);
  if (!HAS_PUMP) return;
  check_pressure();
  check_switch();
}

}
