// Made from softgrip/board/protocol.py by: python -m softgrip.board.firmware.header
// Do not edit.
#pragma once
#include <stdint.h>

const uint8_t PROTOCOL_VERSION = 1;
const uint32_t PROTOCOL_TABLE = 0x9eb5765d;
const uint32_t BUILD = 0x82b5f39b;
const uint32_t BAUD = 250000;
const uint16_t TICKS_PER_SECOND = 1000;
const uint8_t TICKS_PER_FRAME = 25;
const int16_t SPEED_SCALE = 256;
const uint8_t CHANNELS = 14;
const uint8_t CHANNEL_PRESSURE = 9;
const uint8_t LARGEST_FRAME = 49;  // before it is stuffed

enum SetUp : uint16_t {
  SetUp_GRIPPER = 1,
  SetUp_PAD = 2,
};
enum Flag : uint16_t {
  Flag_HOMED = 1,
  Flag_MOVING = 2,
  Flag_HOMING = 4,
  Flag_ESTOPPED = 8,
  Flag_HOST_SILENT = 16,
  Flag_OVER_PRESSURE = 32,
  Flag_SENSOR_RANGE = 64,
  Flag_SENSOR_STUCK = 128,
  Flag_POSITION_LIMIT = 256,
  Flag_HOME_SWITCH = 512,
  Flag_SWITCH_FAULT = 1024,
  Flag_GREETED = 2048,
  Flag_VALVE_OPEN = 4096,
};
enum Reason : uint16_t {
  Reason_UNKNOWN_MESSAGE = 1,
  Reason_WRONG_LENGTH = 2,
  Reason_STALE = 3,
  Reason_WRONG_VERSION = 4,
  Reason_NOT_GREETED = 5,
  Reason_ESTOPPED = 6,
  Reason_NOT_HOMED = 7,
  Reason_OVER_PRESSURE = 8,
  Reason_SENSOR_FAULT = 9,
  Reason_POSITION_LIMIT = 10,
  Reason_SPEED_LIMIT = 11,
  Reason_HARD_BOUND = 12,
  Reason_MOVING = 13,
  Reason_STILL_FAULTY = 14,
  Reason_NO_PUMP = 15,
  Reason_NO_VALVE = 16,
};

// Greet; before it the board moves nothing.
const uint8_t ID_HELLO = 1;
struct __attribute__((packed)) Hello {
  uint8_t version;  // of the protocol
  uint32_t table;  // checksum of this table
};
static_assert(sizeof(Hello) == 5, "as in Python");
// Turn at a speed until told otherwise. Refused, it brings the motor to rest, unless homing.
const uint8_t ID_SETPOINT = 2;
struct __attribute__((packed)) Setpoint {
  int32_t speed;  // 1/256 step/s; positive into the syringe
};
static_assert(sizeof(Setpoint) == 4, "as in Python");
// The host is alive.
const uint8_t ID_HEARTBEAT = 3;
// Stop at once, and stay so until CLEAR.
const uint8_t ID_ESTOP = 4;
// End an emergency stop and latched faults, if their cause is gone.
const uint8_t ID_CLEAR = 5;
// Find the home switch: position 0, the plunger drawn out.
const uint8_t ID_HOME = 6;
// Set the limits; at rest only.
const uint8_t ID_SET_LIMITS = 7;
struct __attribute__((packed)) SetLimits {
  uint16_t pressure;  // count; at which pushing stops
  int32_t position;  // step; furthest into the syringe, from home
  uint16_t speed;  // step/s; largest
  uint16_t acceleration;  // step/s^2; largest
  uint16_t silence;  // ms; of the host, after which the motor stops
};
static_assert(sizeof(SetLimits) == 12, "as in Python");
// Open or shut the valve.
const uint8_t ID_VENT = 8;
struct __attribute__((packed)) Vent {
  uint8_t open;  // 1 to open
};
static_assert(sizeof(Vent) == 1, "as in Python");
// Ask for the counters.
const uint8_t ID_COUNTERS = 9;
// Who the board is.
const uint8_t ID_HELLO_ANSWER = 129;
struct __attribute__((packed)) HelloAnswer {
  uint8_t version;  // of the protocol
  uint32_t table;  // checksum of this table
  uint32_t build;  // checksum of the firmware's sources
  uint8_t set_up;  // a SetUp
  uint8_t reset_cause;  // a ResetCause
  uint8_t valve;  // 1 if there is one
  uint16_t steps;  // step/rev; of the motor and its driver
  uint16_t pressure;  // count; at which pushing stops
  int32_t position;  // step; furthest into the syringe, from home
  uint16_t speed;  // step/s; largest
  uint16_t acceleration;  // step/s^2; largest
  uint16_t silence;  // ms; of the host, after which the motor stops
  uint16_t hard_pressure;  // count; bound of pressure
  int32_t hard_position;  // step; bound of position
  uint16_t hard_speed;  // step/s; bound of speed
  uint16_t hard_acceleration;  // step/s^2; bound of acceleration
  uint16_t hard_silence;  // ms; bound of silence
};
static_assert(sizeof(HelloAnswer) == 38, "as in Python");
// Done.
const uint8_t ID_ACK = 130;
struct __attribute__((packed)) Ack {
  uint8_t id;  // of the message
};
static_assert(sizeof(Ack) == 1, "as in Python");
// Refused.
const uint8_t ID_NACK = 131;
struct __attribute__((packed)) Nack {
  uint8_t id;  // of the message
  uint8_t reason;  // a Reason
};
static_assert(sizeof(Nack) == 2, "as in Python");
// What the board sees, at 40 Hz.
const uint8_t ID_TELEMETRY = 132;
struct __attribute__((packed)) Telemetry {
  uint16_t number;  // of the frame, round from 65535
  uint32_t time;  // ms; since the reset
  uint16_t channels[14];  // count; k < 9 read 13 - k ms ago, k > 9 14 - k
  int32_t position;  // step; since home, or since the reset
  int32_t speed;  // 1/256 step/s; of the motor
  uint16_t flags;  // of Flag
  uint8_t last;  // sequence number acknowledged last
};
static_assert(sizeof(Telemetry) == 45, "as in Python");
// Frames since the reset.
const uint8_t ID_COUNTERS_ANSWER = 137;
struct __attribute__((packed)) CountersAnswer {
  uint32_t good;  // frame; valid
  uint16_t bad;  // frame; with a wrong checksum, or cut
  uint16_t overlong;  // frame; longer than any message
  uint16_t lost;  // frame; skipped sequence numbers
  uint16_t stale;  // frame; refused as older than the last
  uint16_t dropped;  // frame; of the board's own that found no room
};
static_assert(sizeof(CountersAnswer) == 14, "as in Python");
