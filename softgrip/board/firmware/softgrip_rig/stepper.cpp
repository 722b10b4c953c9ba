#include "stepper.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "pins.h"
#include "protocol.h"

namespace stepper {

const uint32_t TICKS = F_CPU / 8;     // of timer 1, per second
const uint32_t SLOWEST = 4 * TICKS;   // a period longer than 4 s is rest
const uint16_t PULSE = 100;           // ticks, 50 us: long enough for any driver of this kind
const uint16_t FARTHEST = 0x4000;     // ticks ahead of a match, so that differences have a sign
const uint8_t LEASE = 12;             // steps, 3 ms of the highest speed
const int16_t MARGIN = 16;            // ticks, 8 us: a match nearer than this is left as it is

enum Next : uint8_t { IDLE, WAIT, RISE, FALL };  // what the next match of the timer does

static volatile Next next;
static volatile uint32_t period, wait;  // ticks of a step; ticks from the next match to the rise
static volatile uint8_t allowed;
static volatile int32_t place, last_place;
static volatile int8_t direction = 1;

// What the pin does at the next match, and when that is.
static void at_match(Next what, uint16_t time) {
  next = what;
  TCCR1A = what == RISE ? _BV(COM1A1) | _BV(COM1A0) : what == FALL ? _BV(COM1A1) : 0;
  OCR1A = time;
}

static void idle() {
  TIMSK1 = 0;
  TCCR1A = 0;
  next = IDLE;
}

// Plans the rise so many ticks after a time of the timer.
static void plan(uint16_t from, uint32_t ticks) {
  if (ticks > FARTHEST) {
    // Half of it: what is left is never so short that the interrupt comes too late for it.
    wait = ticks - FARTHEST / 2;
    at_match(WAIT, from + FARTHEST / 2);
  } else {
    wait = 0;
    at_match(RISE, from + ticks);
  }
}

ISR(TIMER1_COMPA_vect) {
  if (next == RISE) {
    place += direction;
    if (allowed) --allowed;
    if (place == last_place) allowed = 0;
    at_match(FALL, OCR1A + PULSE);
  } else if (!allowed || !period) {
    idle();
  } else {
    plan(OCR1A, next == FALL ? period - PULSE : wait);
  }
}

void begin() {
  PORTB &= ~(STEP | DIR);
  DDRB |= STEP | DIR;
  TCCR1A = 0;
  TCCR1B = _BV(CS11);
  TIMSK1 = 0;
}

// The rise moves by what the period grows, but not into the past.
static void retime(uint32_t wanted) {
  uint16_t now = TCNT1;
  int16_t near = OCR1A - now;
  int32_t left = int32_t(wait) + int32_t(wanted - period);
  period = wanted;
  if (next == FALL) return;
  if (near >= MARGIN) {
    left += near;
    plan(now, left < MARGIN ? MARGIN : left);
  } else if (next == WAIT) {
    wait = left < MARGIN ? MARGIN : left;
  }
}

static void start(int8_t way, uint32_t wanted) {
  direction = way;
  if (way < 0) PORTB &= ~DIR;
  else PORTB |= DIR;
  period = wanted;
  OCR1A = TCNT1 - 1;  // far from a match while the pin is made ready
  plan(TCNT1, wanted);
  TIFR1 = _BV(OCF1A);
  TIMSK1 = _BV(OCIE1A);
}

void run(int32_t speed, int32_t end) {
  int8_t way = speed < 0 ? -1 : 1;
  uint32_t wanted = speed ? TICKS * SPEED_SCALE / (way * speed) : SLOWEST;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    bool turns = next != IDLE && way != direction;
    if (wanted >= SLOWEST || turns || way * (end - place) <= 0) {
      stop();
    } else {
      allowed = LEASE;
      last_place = end;
      if (next == IDLE) start(way, wanted);
      else if (wanted != period) retime(wanted);
    }
  }
}

void stop() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    allowed = 0;
    // A pulse that is out is ended and counted by its interrupts; the next rise is called off.
    if ((next == RISE || next == WAIT) && int16_t(OCR1A - TCNT1) >= MARGIN) idle();
  }
}

int32_t position() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { return place; }
  return 0;
}

void set_position(int32_t position) {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { place = position; }
}

}
