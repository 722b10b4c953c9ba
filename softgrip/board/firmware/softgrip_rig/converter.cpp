#include "converter.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "protocol.h"

namespace converter {

volatile uint16_t counts[CHANNELS];
volatile bool sampled;
static volatile uint32_t ticks;
static volatile uint8_t tick_phase;
static uint8_t channel;

static void start(uint8_t which) {
  channel = which;
  ADMUX = _BV(REFS0) | (which & 7);
  ADCSRB = which & 8 ? _BV(MUX5) : 0;
  ADCSRA |= _BV(ADSC);
}

ISR(TIMER3_COMPA_vect) {
  ++ticks;
  tick_phase = tick_phase + 1 == TICKS_PER_FRAME ? 0 : tick_phase + 1;
  start(CHANNEL_PRESSURE);
}

ISR(ADC_vect) {
  counts[channel] = ADC;
  if (channel != CHANNEL_PRESSURE) return;
  sampled = true;
  // Each other channel once a frame, at a tick of its own.
  uint8_t other = tick_phase < CHANNEL_PRESSURE ? tick_phase : tick_phase + 1;
  if (other < CHANNELS) start(other);
}

void begin() {
  TIMSK0 = 0;  // the core's clock is not used, and would wake the board a thousand times a second
  ADCSRA = _BV(ADEN) | _BV(ADIE) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);  // 125 kHz: 0.1 ms each
  TCCR3A = 0;
  TCCR3B = _BV(WGM32) | _BV(CS30);
  TCNT3 = 0;
  OCR3A = F_CPU / TICKS_PER_SECOND - 1;
  TIMSK3 = _BV(OCIE3A);
}

uint32_t now() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { return ticks; }
  return 0;
}

uint8_t phase() { return tick_phase; }

uint16_t count(uint8_t which) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { return counts[which]; }
  return 0;
}

}
