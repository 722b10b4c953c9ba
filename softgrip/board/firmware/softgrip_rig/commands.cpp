#include "commands.h"

#include <avr/io.h>

#include "interlocks.h"
#include "motion.h"
#include "pins.h"
#include "reset.h"
#include "state.h"

namespace commands {

using framing::Frame;

uint8_t last;
static uint8_t last_reason;  // of the last command's answer: 0 for ACK
static uint32_t good;
static uint16_t lost, stale;

static uint8_t hello(const Frame& frame) {
  Hello asked = *reinterpret_cast<const Hello*>(frame.payload);
  if (asked.version != PROTOCOL_VERSION || asked.table != PROTOCOL_TABLE) {
    return Reason_WRONG_VERSION;
  }
  motion::rest();  // a host that begins anew begins at rest
  set(Flag_GREETED, true);
  HelloAnswer answer = {
      PROTOCOL_VERSION, PROTOCOL_TABLE, BUILD, SET_UP, reset::cause, HAS_VALVE,
      STEPS_PER_REVOLUTION,
      limits.pressure, limits.position, limits.speed, limits.acceleration, limits.silence,
      HARD.pressure, HARD.position, HARD.speed, HARD.acceleration, HARD.silence};
  framing::send(ID_HELLO_ANSWER, frame.sequence, &answer, sizeof answer);
  return 0;
}

static bool within(const SetLimits& low, const SetLimits& asked, const SetLimits& high) {
  return low.pressure <= asked.pressure && asked.pressure <= high.pressure &&
         low.position <= asked.position && asked.position <= high.position &&
         low.speed <= asked.speed && asked.speed <= high.speed &&
         low.acceleration <= asked.acceleration && asked.acceleration <= high.acceleration &&
         low.silence <= asked.silence && asked.silence <= high.silence;
}

static uint8_t set_limits(const Frame& frame) {
  SetLimits asked = *reinterpret_cast<const SetLimits*>(frame.payload);
  if (has(Flag_MOVING | Flag_HOMING)) return Reason_MOVING;
  if (!within(LEAST, asked, HARD)) return Reason_HARD_BOUND;
  limits = asked;
  return 0;
}

static uint8_t vent(const Frame& frame) {
  if (!HAS_VALVE) return Reason_NO_VALVE;
  bool open = frame.payload[0];
  if (open) PORTH |= VENT_OUT;
  else PORTH &= ~VENT_OUT;
  set(Flag_VALVE_OPEN, open);
  return 0;
}

static void counters(const Frame& frame) {
  CountersAnswer answer = {good, framing::bad, framing::overlong, lost, stale, framing::dropped};
  framing::send(ID_COUNTERS_ANSWER, frame.sequence, &answer, sizeof answer);
}

// Bytes of a payload, or -1 for what is no command.
static int8_t size_of(uint8_t id) {
  switch (id) {
    case ID_HELLO: return sizeof(Hello);
    case ID_SETPOINT: return sizeof(Setpoint);
    case ID_SET_LIMITS: return sizeof(SetLimits);
    case ID_VENT: return sizeof(Vent);
    case ID_HEARTBEAT:
    case ID_ESTOP:
    case ID_CLEAR:
    case ID_HOME:
    case ID_COUNTERS: return 0;
    default: return -1;
  }
}

static uint8_t act(const Frame& frame) {
  switch (frame.id) {
    case ID_SETPOINT:
      return motion::want(reinterpret_cast<const Setpoint*>(frame.payload)->speed);
    case ID_CLEAR: return interlocks::clear();
    case ID_HOME: return motion::home();
    case ID_SET_LIMITS: return set_limits(frame);
    case ID_VENT: return vent(frame);
    default: return 0;  // a heartbeat
  }
}

static void answer(const Frame& frame, uint8_t reason) {
  if (reason) {
    Nack nack = {frame.id, reason};
    framing::send(ID_NACK, frame.sequence, &nack, sizeof nack);
  } else {
    Ack ack = {frame.id};
    framing::send(ID_ACK, frame.sequence, &ack, sizeof ack);
  }
}

// Notes a command of its turn, which is carried out.
static void advance(uint8_t sequence) {
  uint8_t ahead = sequence - last;
  if (ahead == 0 || ahead >= 128) return;
  lost += ahead - 1;
  last = sequence;
  last_reason = 0;
}

void handle(const Frame& frame) {
  ++good;
  interlocks::heard();
  int8_t size = size_of(frame.id);
  uint8_t ahead = frame.sequence - last;
  if (size < 0) {
    answer(frame, Reason_UNKNOWN_MESSAGE);
  } else if (frame.size != size) {
    answer(frame, Reason_WRONG_LENGTH);
  } else if (frame.id == ID_ESTOP) {
    interlocks::estop();
    advance(frame.sequence);
    answer(frame, 0);
  } else if (frame.id == ID_HELLO) {
    last_reason = hello(frame);
    last = frame.sequence;
    if (last_reason) answer(frame, last_reason);
  } else if (frame.id == ID_COUNTERS) {
    advance(frame.sequence);
    counters(frame);
  } else if (!has(Flag_GREETED)) {
    answer(frame, Reason_NOT_GREETED);
  } else if (ahead == 0) {
    answer(frame, last_reason);  // repeated: answered again, not carried out again
  } else if (ahead >= 128) {
    ++stale;
    answer(frame, Reason_STALE);
  } else {
    advance(frame.sequence);
    last_reason = act(frame);
    answer(frame, last_reason);
  }
}

}
