/* The board of the rig on simavr, stepped in virtual time.
 *
 * Copyright (C) 2024 The softgrip developers
 *
 * This file, which links to simavr and is compiled where it runs, is free software: you can redistribute it
 * and/or modify it under the terms of the GNU General Public License as published by the Free
 * Software Foundation, version 3 or any later version. It comes without any warranty; see
 * <https://www.gnu.org/licenses/>. No other file of softgrip links to it or is under that license.
 */
#include <stdlib.h>
#include <string.h>

#include "avr_adc.h"
#include "avr_ioport.h"
#include "avr_uart.h"
#include "sim_avr.h"
#include "sim_elf.h"

enum { STEP = 5, DIR = 6, SWITCH = 5, VALVE = 6, PORTB = 0x25, PORTH = 0x102, TCCR1A = 0x80, MCUSR = 0x54 };
enum { SWITCH_WORKS, SWITCH_HIGH, SWITCH_LOW };
/* Of 10 bits at 250 kBd and 16 MHz. simavr 1.6 itself takes 11, 704 cycles, from byte to byte in
 * both directions, since it counts a parity bit whatever the mode is: what is measured here of whole
 * frames is up to a tenth slower than on a board. */
enum { BYTE_CYCLES = 640 };

typedef struct {
  avr_cycle_count_t *times;
  int8_t *values;
  size_t count, room;
} log_t;

typedef struct board_t {
  avr_t *avr;
  avr_irq_t *uart_in, *adc, *home_switch;
  uint16_t millivolts[16];
  int32_t position;
  int switch_mode, step_level, full;
  log_t edges, sent;
  uint8_t *queue;
  size_t queue_from, queue_to, queue_room;
  avr_cycle_count_t next_byte;
} board_t;

static void note(log_t *log, avr_cycle_count_t time, int8_t value) {
  if (log->count == log->room) {
    log->room = log->room ? 2 * log->room : 1024;
    log->times = realloc(log->times, log->room * sizeof *log->times);
    log->values = realloc(log->values, log->room);
  }
  log->times[log->count] = time;
  log->values[log->count++] = value;
}

static void set_switch(board_t *board) {
  int high = board->switch_mode == SWITCH_HIGH ||
             (board->switch_mode == SWITCH_WORKS && board->position <= 0);
  /* Twice: an equal value may be filtered, and a reset of the chip forgets the pin's. */
  avr_raise_irq(board->home_switch, !high);
  avr_raise_irq(board->home_switch, high);
}

static void on_step(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq;
  board_t *board = param;
  /* simavr also tells writes of the same value; and when the timer overflows, it raises a pin
   * that a match is to clear and clears one that it is to set, which is right in PWM modes only. */
  int on_match = board->avr->data[TCCR1A] & 0xC0;
  if (on_match == (value ? 0x80 : 0xC0) || (int)value == board->step_level) return;
  board->step_level = value;
  if (!value) return;
  int8_t way = board->avr->data[PORTB] >> DIR & 1 ? 1 : -1;
  board->position += way;
  note(&board->edges, board->avr->cycle, way);
  set_switch(board);
}

/* simavr's receiver holds 64 bytes, and drops those that come when it is full. */
static void on_full(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq, (void)value;
  ((board_t *)param)->full = 1;
}

static void on_room(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq, (void)value;
  ((board_t *)param)->full = 0;
}

static void on_byte(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq;
  board_t *board = param;
  note(&board->sent, board->avr->cycle + BYTE_CYCLES, value);
}

static void on_conversion(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq, (void)value;
  board_t *board = param;
  /* simavr 1.6 knows 8 channels: the upper ones are read on the lower ones' lines. */
  int channel = (board->avr->data[0x7C] & 7) | (board->avr->data[0x7B] & 8);
  avr_raise_irq(board->adc + (channel & 7), board->millivolts[channel]);
}

static void no_sleep(avr_t *avr, avr_cycle_count_t cycles) { (void)avr, (void)cycles; }

static avr_cycle_count_t wake(avr_t *avr, avr_cycle_count_t when, void *param) {
  (void)avr, (void)when, (void)param;
  return 0;
}

static void quiet(avr_t *avr, const int level, const char *format, va_list list) {
  (void)avr, (void)level, (void)format, (void)list;
}

void board_free(board_t *board) {
  if (board->avr) avr_terminate(board->avr);
  free(board->edges.times), free(board->edges.values);
  free(board->sent.times), free(board->sent.values);
  free(board->queue), free(board);
}

board_t *board_new(const char *elf) {
  board_t *board = calloc(1, sizeof *board);
  elf_firmware_t firmware = {0};
  avr_global_logger_set(quiet);
  if (elf_read_firmware(elf, &firmware) || !(board->avr = avr_make_mcu_by_name("atmega2560"))) {
    board_free(board);
    return NULL;
  }
  avr_t *avr = board->avr;
  avr_init(avr);
  avr->log = 0;
  firmware.frequency = avr->frequency = 16000000;
  avr_load_firmware(avr, &firmware);
  avr->vcc = avr->avcc = avr->aref = 5000;
  avr->sleep = no_sleep;
  avr->data[MCUSR] = 1; /* power-on */

  uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  board->uart_in = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT),
                          on_byte, board);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XOFF),
                          on_full, board);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XON),
                          on_room, board);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B'), STEP), on_step, board);
  board->home_switch = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('H'), SWITCH);
  board->adc = avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER),
                          on_conversion, board);
  for (avr_io_t *io = avr->io_port; io; io = io->next) {
    if (strcmp(io->kind, "adc")) continue;
    for (int k = 0; k < 8; ++k) {
      ((avr_adc_t *)io)->muxmode[0x20 + k] = (avr_adc_mux_t)AVR_ADC_SINGLE(k);
    }
  }
  return board;
}

static void feed(board_t *board) {
  if (board->queue_from == board->queue_to || board->avr->cycle < board->next_byte) return;
  if (!board->full) avr_raise_irq(board->uart_in, board->queue[board->queue_from++]);
  board->next_byte = board->avr->cycle + BYTE_CYCLES;
}

/* Runs up to a cycle; returns 0, or the state of a chip that crashed. */
int board_run(board_t *board, avr_cycle_count_t until) {
  avr_t *avr = board->avr;
  while (avr->cycle < until) {
    set_switch(board); /* each millisecond: a reset forgets it */
    feed(board);
    avr_cycle_count_t stop = until;
    if (avr->cycle + 16000 < stop) stop = avr->cycle + 16000;
    if (board->queue_from < board->queue_to && board->next_byte < stop) stop = board->next_byte;
    if (stop > avr->cycle) {
      /* A sleeping chip jumps to its next timer: this one is ours. */
      avr_cycle_timer_cancel(avr, wake, board);
      avr_cycle_timer_register(avr, stop - avr->cycle, wake, board);
    }
    while (avr->cycle < stop) {
      int state = avr_run(avr);
      if (state == cpu_Done || state == cpu_Crashed) return state;
    }
  }
  return 0;
}

/* Bytes that are still on their way to the chip. */
size_t board_pending(board_t *board) { return board->queue_to - board->queue_from; }

void board_write(board_t *board, const uint8_t *data, size_t size) {
  if (board->queue_to + size > board->queue_room) {
    board->queue_room = 2 * (board->queue_to + size);
    board->queue = realloc(board->queue, board->queue_room);
  }
  if (board->queue_from == board->queue_to && board->next_byte < board->avr->cycle) {
    board->next_byte = board->avr->cycle;
  }
  if (board->queue_from == board->queue_to) board->queue_from = board->queue_to = 0;
  memcpy(board->queue + board->queue_to, data, size);
  board->queue_to += size;
}

/* Takes the bytes that have come by now; the room must hold them. */
size_t board_read(board_t *board, uint8_t *data, double *times, size_t room) {
  log_t *sent = &board->sent;
  size_t count = 0;
  while (count < sent->count && count < room && sent->times[count] <= board->avr->cycle) {
    data[count] = sent->values[count];
    times[count] = sent->times[count] / 16e6;
    ++count;
  }
  sent->count -= count;
  memmove(sent->values, sent->values + count, sent->count);
  memmove(sent->times, sent->times + count, sent->count * sizeof *sent->times);
  return count;
}

/* Cycle at which the next byte will have come, or 0. */
avr_cycle_count_t board_due(board_t *board) { return board->sent.count ? board->sent.times[0] : 0; }

avr_cycle_count_t board_cycle(board_t *board) { return board->avr->cycle; }
size_t board_edges(board_t *board) { return board->edges.count; }
const avr_cycle_count_t *board_edge_times(board_t *board) { return board->edges.times; }
const int8_t *board_edge_ways(board_t *board) { return board->edges.values; }
int board_valve(board_t *board) { return board->avr->data[PORTH] >> VALVE & 1; }
int32_t board_position(board_t *board) { return board->position; }
void board_place(board_t *board, int32_t position) { board->position = position; }
void board_switch(board_t *board, int mode) { board->switch_mode = mode; }
void board_volts(board_t *board, int channel, int millivolts) {
  board->millivolts[channel] = millivolts;
}

/* Lets the program run in circles from now on, with its interrupts or without. */
void board_hang(board_t *board, uint32_t loop, int interrupts) {
  board->avr->pc = loop;
  board->avr->sreg[S_I] = interrupts;
  board->avr->state = cpu_Running;
}
