#include "motion.h"

#include <math.h>

#include "interlocks.h"
#include "pins.h"
#include "state.h"
#include "stepper.h"

namespace motion {

enum Stage : uint8_t { NONE, LEAVE, SEEK };  // of homing: push off the switch, draw back on it

static Stage stage;
static int32_t wanted, current;
static int32_t started;  // where a stage of homing began

static void enter(Stage to) {
  stage = to;
  started = stepper::position();
  set(Flag_HOMING, stage != NONE);
}

// Where motion at a speed must end.
static int32_t end(int32_t speed) {
  int32_t place = stepper::position();
  if (speed > 0) {
    if (!interlocks::may_push()) return place;
    if (stage == LEAVE) return started + LEAVING_STEPS;
    return has(Flag_HOMED) ? limits.position : place;
  }
  if (has(Flag_HOME_SWITCH)) return place;
  if (stage == SEEK) return started - HARD.position - LEAVING_STEPS;
  return has(Flag_HOMED) ? 0 : place - HARD.position;
}

static int32_t room(int32_t speed) {
  int32_t left = end(speed) - stepper::position();
  return speed > 0 ? left : -left;
}

void begin() {
  stepper::begin();
  PORTH |= SWITCH;  // pull-up
}

uint8_t want(int32_t speed) {
  uint8_t reason = 0;
  int32_t largest = int32_t(limits.speed) * SPEED_SCALE;
  if (!HAS_PUMP) return Reason_NO_PUMP;
  if (has(Flag_HOMING)) return Reason_MOVING;
  if (has(Flag_ESTOPPED)) reason = Reason_ESTOPPED;
  else if (speed > largest || speed < -largest) reason = Reason_SPEED_LIMIT;
  else if (speed > 0 && !has(Flag_HOMED)) reason = Reason_NOT_HOMED;
  else if (speed > 0 && has(Flag_SENSOR_RANGE | Flag_SENSOR_STUCK)) reason = Reason_SENSOR_FAULT;
  else if (speed > 0 && has(Flag_OVER_PRESSURE)) reason = Reason_OVER_PRESSURE;
  else if (speed && room(speed) <= 0) reason = Reason_POSITION_LIMIT;
  wanted = reason ? 0 : speed;
  return reason;
}

uint8_t home() {
  if (!HAS_PUMP) return Reason_NO_PUMP;
  if (has(Flag_ESTOPPED)) return Reason_ESTOPPED;
  if (has(Flag_MOVING)) return Reason_MOVING;
  if (has(Flag_SWITCH_FAULT)) return Reason_SENSOR_FAULT;
  if (has(Flag_HOME_SWITCH) && !interlocks::may_push()) return Reason_SENSOR_FAULT;
  set(Flag_HOMED, false);
  // Only a switch that is seen to open and to close is believed.
  enter(has(Flag_HOME_SWITCH) ? LEAVE : SEEK);
  return 0;
}

void rest() {
  wanted = 0;
  enter(NONE);
}

void halt() {
  stepper::stop();
  current = 0;
  rest();
}

int32_t speed() { return current; }

static void fail_homing() {
  set(Flag_SWITCH_FAULT, true);
  halt();
}

static void arrive() {
  halt();
  stepper::set_position(0);
  interlocks::begin_anew();
  set(Flag_HOMED, true);
}

static int32_t homing_speed() {
  bool pressed = has(Flag_HOME_SWITCH);
  if (stage == LEAVE && !pressed) {
    halt();
    enter(SEEK);
  } else if (stage == SEEK && pressed) {
    arrive();
  } else if (room(stage == LEAVE ? 1 : -1) <= 0) {
    fail_homing();
  }
  return stage == LEAVE ? HOMING_SPEED : stage == SEEK ? -HOMING_SPEED : 0;
}

// The speed from which the motor can still stop within so many steps.
static int32_t braking(int32_t steps) {
  if (steps > HARD.position) steps = HARD.position;
  // At nine tenths of the limit: the speed follows a tick late.
  return SPEED_SCALE * sqrt(1.8 * limits.acceleration * steps);
}

static int32_t between(int32_t low, int32_t value, int32_t high) {
  return value < low ? low : value > high ? high : value;
}

void tick() {
  if (!interlocks::may_move() && (current || stage != NONE || wanted)) halt();
  int32_t goal = stage == NONE ? wanted : homing_speed();
  int32_t way = current ? current : goal;
  int32_t steps = way ? room(way) : 0;
  if (way && steps <= 0) {
    // An end of the stroke, or pushing is forbidden: no ramp, and no going on by itself later.
    halt();
    goal = 0;
  } else if (way) {
    int32_t fastest = braking(steps);
    goal = between(-fastest, goal, fastest);
  }
  int32_t change = limits.acceleration * int32_t(SPEED_SCALE) / TICKS_PER_SECOND;
  int32_t faster = current + between(-change, goal - current, change);
  // Through rest, so that DIR never changes under way.
  current = (current > 0 && faster < 0) || (current < 0 && faster > 0) ? 0 : faster;
  stepper::run(current, end(current));
  set(Flag_MOVING, current != 0);
  set(Flag_POSITION_LIMIT, has(Flag_HOMED) && stepper::position() >= limits.position);
}

}
