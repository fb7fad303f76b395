/* The shared memory of an I/O device "SharedMemory", for the other side: a visualisation, a plant
 * model. Plain C11 or C++ with GCC's atomic builtins; no library of Stride's is needed.
 *
 * The segment (shm_open) begins with this header; inputs and outputs of the program follow at the
 * offsets that it names. Both directions have two counters: whoever writes adds 1 to `begin`,
 * writes bytes, adds 1 to `end`. Whoever reads takes `end`, the bytes, then `begin`: when both are
 * equal the bytes belong together, else it tries again. Nobody ever waits for the other one.
 */
#ifndef STRIDE_RUNTIME_IO_STRIDE_IO_H
#define STRIDE_RUNTIME_IO_STRIDE_IO_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define STRIDE_IO_MAGIC 0x4F495453U /* "STIO" */
#define STRIDE_IO_VERSION 1U
#define STRIDE_IO_RUNNING 1U /* the program's outputs are there */
#define STRIDE_IO_STOPPED 2U /* the program has stopped: safe values are there */

typedef struct stride_io_header {
  uint32_t magic; /* written last by Stride: with it the header is complete */
  uint32_t version;
  uint32_t input_bytes; /* of the program; the other side writes them */
  uint32_t output_bytes;
  uint32_t input_offset; /* from the start of the segment */
  uint32_t output_offset;
  uint32_t state; /* STRIDE_IO_RUNNING, STRIDE_IO_STOPPED */
  uint32_t reserved;
  uint64_t input_begin; /* written by the other side, also as its sign of life */
  uint64_t input_end;
  uint64_t output_begin; /* written by Stride */
  uint64_t output_end;
} stride_io_header;

/* Writes all or some of the program's inputs. One writer only. */
static inline void stride_io_write_inputs(stride_io_header *io, uint32_t first, const void *from,
                                          uint32_t count) {
  /* Whoever was killed in here has left the counters unequal; this makes them equal again. */
  const uint64_t number = __atomic_load_n(&io->input_begin, __ATOMIC_SEQ_CST) + 1;
  __atomic_store_n(&io->input_begin, number, __ATOMIC_SEQ_CST);
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  memcpy((unsigned char *)io + io->input_offset + first, from, count);
  __atomic_store_n(&io->input_end, number, __ATOMIC_SEQ_CST);
}

/* Reads the program's outputs; 0: they are being written just now, try again. */
static inline int stride_io_read_outputs(const stride_io_header *io, uint32_t first, void *to,
                                         uint32_t count) {
  const uint64_t end = __atomic_load_n(&io->output_end, __ATOMIC_SEQ_CST);
  memcpy(to, (const unsigned char *)io + io->output_offset + first, count);
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  return __atomic_load_n(&io->output_begin, __ATOMIC_SEQ_CST) == end;
}

#endif
