// Frames: id, sequence number, payload and CRC-16/CCITT-FALSE, stuffed by COBS, ended by a 0.
#pragma once
#include <stdint.h>

namespace framing {

struct Frame {
  uint8_t id, sequence, size;
  const uint8_t* payload;
};

extern uint16_t bad, overlong, dropped;

bool receive(uint8_t byte, Frame& frame);  // true when the byte ends a valid frame
void send(uint8_t id, uint8_t sequence, const void* payload, uint8_t size);

}
