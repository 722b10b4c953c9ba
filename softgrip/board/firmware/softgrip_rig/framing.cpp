#include "framing.h"

#include <string.h>
#include <util/crc16.h>

#include "protocol.h"
#include "uart.h"

namespace framing {

uint16_t bad, overlong, dropped;

uint16_t checksum(const uint8_t* data, uint8_t size) {
  uint16_t crc = 0xFFFF;
  while (size--) crc = _crc_xmodem_update(crc, *data++);
  return crc;
}

// Undoes COBS in place; a damaged block gives 0.
uint8_t unstuff(uint8_t* data, uint8_t size) {
  uint8_t from = 0, to = 0;
  while (from < size) {
    uint8_t code = data[from++];
    if (code - 1 > size - from) return 0;
    for (uint8_t k = 1; k < code; ++k) data[to++] = data[from++];
    if (from < size) data[to++] = 0;  // no block of ours is long enough for code 255
  }
  return to;
}

bool receive(uint8_t byte, Frame& frame) {
  static uint8_t data[LARGEST_FRAME + 1];  // stuffing adds one byte
  static uint8_t size;
  static bool over;
  if (byte) {
    if (size < sizeof data) data[size++] = byte;
    else over = true;
    return false;
  }
  uint8_t length = size;
  bool too_long = over;
  size = 0;
  over = false;
  if (too_long) {
    ++overlong;
    return false;
  }
  if (length == 0) return false;
  length = unstuff(data, length);
  if (length < 4 ||
      checksum(data, length - 2) != uint16_t(data[length - 2] | data[length - 1] << 8)) {
    ++bad;
    return false;
  }
  frame = Frame{data[0], data[1], uint8_t(length - 4), data + 2};
  return true;
}

void send(uint8_t id, uint8_t sequence, const void* payload, uint8_t size) {
  uint8_t data[LARGEST_FRAME], stuffed[LARGEST_FRAME + 2];
  data[0] = id;
  data[1] = sequence;
  memcpy(data + 2, payload, size);
  uint16_t crc = checksum(data, size + 2);
  data[size + 2] = crc & 0xFF;
  data[size + 3] = crc >> 8;
  uint8_t code = 0, to = 1;  // where the number of bytes up to the next 0 goes
  for (uint8_t k = 0; k < size + 4; ++k) {
    if (data[k]) {
      stuffed[to++] = data[k];
    } else {
      stuffed[code] = to - code;
      code = to++;
    }
  }
  stuffed[code] = to - code;
  stuffed[to++] = 0;
  if (!uart::send(stuffed, to)) ++dropped;
}

}
