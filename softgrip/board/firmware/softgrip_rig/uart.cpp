#include "uart.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "protocol.h"

namespace uart {

// Of 256 bytes, so that an index of one byte goes round by itself.
volatile uint8_t in[256], out[256];
volatile uint8_t in_head, in_tail, out_head, out_tail;

ISR(USART0_RX_vect) {
  uint8_t byte = UDR0;
  // A full ring loses the byte: the frame's checksum tells.
  if (uint8_t(in_head + 1) != in_tail) in[in_head++] = byte;
}

ISR(USART0_UDRE_vect) {
  UDR0 = out[out_tail++];
  if (out_tail == out_head) UCSR0B &= ~_BV(UDRIE0);
}

void begin() {
  UCSR0A = _BV(U2X0);  // before the divisor: an emulator reads it then
  UBRR0 = F_CPU / 8 / BAUD - 1;
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXCIE0) | _BV(RXEN0) | _BV(TXEN0);
}

bool waiting() { return in_head != in_tail; }

uint8_t take() { return in[in_tail++]; }

bool send(const uint8_t* data, uint8_t size) {
  if (uint8_t(out_tail - out_head - 1) < size) return false;
  for (uint8_t k = 0; k < size; ++k) out[uint8_t(out_head + k)] = data[k];
  uint8_t status = SREG;
  cli();
  out_head += size;
  UCSR0B |= _BV(UDRIE0);
  SREG = status;
  return true;
}

}
