#!/usr/bin/env python3
"""Builds a drive of CiA 402 on lely-core from a checkout: everything but the drive's own states is that stack's.

As a module: build(). The checkout must have been built and installed in its folder `install`, as ./configure --prefix=… does:
docs/developers/contributing.md says how.
"""

import pathlib
import subprocess

NAME, VENDOR, PRODUCT, REVISION, SERIAL = "lely drive", 0x360, 0x402, 7, 4714
U8, U16, U32, I8, I16, I32, TEXT = 5, 6, 7, 2, 3, 4, 9

# Index, access, whether it is in PDOs, and what it is: a value, or a list of subindices with type, value.
OBJECTS = [
    (0x1000, "ro", U32, 0x00020192), (0x1001, "ro", U8, 0), (0x1003, "rw", [(U8, 0)] + [(U32, 0)] * 8),
    (0x1005, "rw", U32, 0x80), (0x1008, "const", TEXT, NAME), (0x1014, "rw", U32, "$NODEID+0x80"),
    (0x1016, "rw", [(U8, 1), (U32, 0)]), (0x1017, "rw", U16, 0),
    (0x1018, "ro", [(U8, 4), (U32, VENDOR), (U32, PRODUCT), (U32, REVISION), (U32, SERIAL)]),
    (0x2000, "rw", U16, 0), (0x2001, "rw", I16, 0), (0x603F, "ro", U16, 0), (0x6040, "rww", U16, 0), (0x6041, "ro", U16, 0x250),
    (0x6060, "rww", I8, 0), (0x6061, "ro", I8, 0), (0x6064, "ro", I32, 2500), (0x607A, "rww", I32, 0), (0x6502, "ro", U32, 0x80),
]


def pdos():
    """Two in each direction, all off but what the master switches on."""
    result = []
    for base, cob, maps in ((0x1400, 0x200, (0x60400010,)), (0x1800, 0x180, (0x60410010,))):
        for number in range(2):
            communication = [(U8, 5), (U32, f"$NODEID+0x{0x80000000 + cob + 0x100 * number:X}"), (U8, 255), (U16, 0), (U8, 0), (U16, 0)]
            result.append((base + number, "rw", communication))
            result.append((base + 0x200 + number, "rw", [(U8, len(maps))] + [(U32, one) for one in maps] + [(U32, 0)] * (8 - len(maps))))
    return result


def dictionary(node):
    """The device as lely-core reads it, by CiA 306."""
    objects = OBJECTS + pdos()
    mandatory = [0x1000, 0x1001, 0x1018]
    groups = (("MandatoryObjects", mandatory), ("OptionalObjects", [o[0] for o in objects if o[0] not in mandatory and not 0x2000 <= o[0] < 0x6000]),
              ("ManufacturerObjects", [o[0] for o in objects if 0x2000 <= o[0] < 0x6000]))
    lines = ["[DeviceInfo]", "VendorName=peer", f"VendorNumber=0x{VENDOR:X}", f"ProductNumber=0x{PRODUCT:X}", f"RevisionNumber={REVISION}",
             "BaudRate_1000=1", "LSS_Supported=1", "NrOfRxPDO=2", "NrOfTxPDO=2", "[DeviceComissioning]", f"NodeID={node}", "Baudrate=1000",
             f"LSS_SerialNumber={SERIAL}", "[DummyUsage]"]
    for name, indices in groups:
        lines += [f"[{name}]", f"SupportedObjects={len(indices)}"] + [f"{i + 1}=0x{index:04X}" for i, index in enumerate(indices)]

    def variable(section, kind, access, value, mapped):
        lines.extend([f"[{section}]", f"ParameterName=o{section}", f"DataType=0x{kind:04X}", f"AccessType={access}",
                      f"PDOMapping={int(mapped)}", f"DefaultValue={value}"])

    for index, access, *what in objects:
        if len(what) == 2:
            variable(f"{index:04X}", what[0], access, what[1], index >= 0x6040)
            continue
        lines.extend([f"[{index:04X}]", f"ParameterName=o{index:04X}", "ObjectType=0x9", f"SubNumber={len(what[0])}"])
        for sub, (kind, value) in enumerate(what[0]):
            number = sub == 0 and index not in (0x1003, *range(0x1600, 0x1C00))
            variable(f"{index:04X}sub{sub}", kind, "const" if number else access, value, False)
    return "\n".join(lines) + "\n"


PROGRAM = r"""
#include <lely/can/net.h>
#include <lely/co/dcf.h>
#include <lely/co/dev.h>
#include <lely/co/emcy.h>
#include <lely/co/nmt.h>
#include <lely/io/can.h>
#include <lely/io/poll.h>
#include <lely/util/time.h>
#include <stdio.h>

enum { FAULT = 0x08, DISABLED = 0x40, READY = 0x21, ON = 0x23, ENABLED = 0x27 };
static unsigned state = DISABLED, before;

/* One transition for each SYNC. */
static unsigned next_state(unsigned word) {
  if (state == FAULT) return word & ~before & 0x80 ? DISABLED : FAULT;
  if (!(word & 2)) return DISABLED;
  if ((word & 0x07) == 0x06) return READY;
  if ((word & 0x07) != 0x07) return state;
  if (state == READY) return ON;
  if (state == ON && word & 8) return ENABLED;
  return state == ENABLED && !(word & 8) ? ON : state;
}

static void on_sync(co_nmt_t *nmt, co_unsigned8_t count, void *data) {
  co_dev_t *dev = data;
  co_unsigned16_t fault = co_dev_get_val_u16(dev, 0x2000, 0);
  co_unsigned8_t maker[5] = {0x34, 0x12, 0, 0, 0};
  unsigned word = co_dev_get_val_u16(dev, 0x6040, 0), old = state;
  (void)count;
  state = fault ? FAULT : next_state(word);
  before = word;
  if (fault) {
    co_dev_set_val_u16(dev, 0x2000, 0, 0);
    co_dev_set_val_u16(dev, 0x603F, 0, fault);
    co_emcy_push(co_nmt_get_emcy(nmt), fault, 0x04, maker);
  } else if (old == FAULT && state == DISABLED) {
    co_dev_set_val_u16(dev, 0x603F, 0, 0);
    co_emcy_pop(co_nmt_get_emcy(nmt), NULL, NULL);
  }
  co_dev_set_val_i8(dev, 0x6061, 0, co_dev_get_val_i8(dev, 0x6060, 0));
  int follows = state == ENABLED && co_dev_get_val_i8(dev, 0x6061, 0) == 8;
  if (follows) co_dev_set_val_i32(dev, 0x6064, 0, co_dev_get_val_i32(dev, 0x607A, 0));
  co_dev_set_val_u16(dev, 0x6041, 0, (co_unsigned16_t)(state | 0x210 | (follows ? 0x1000 : 0)));
}

static int send_frame(const struct can_msg *msg, void *data) { return io_can_write((io_handle_t)data, msg) == 1 ? 0 : -1; }
static int next_time(const struct timespec *tp, void *data) { *(struct timespec *)data = *tp; return 0; }

int main(int argc, char **argv) {
  struct timespec now, next;
  struct io_event event = IO_EVENT_INIT;
  if (argc < 3 || lely_io_init() == -1) return 2;
  io_poll_t *poll = io_poll_create();
  io_handle_t bus = io_open_can(argv[1]);
  if (bus == IO_HANDLE_ERROR || io_set_flags(bus, IO_FLAG_NONBLOCK) == -1) return 3;
  event.events = IO_EVENT_READ;
  event.u.handle = bus;
  io_poll_watch(poll, bus, &event, 1);
  can_net_t *net = can_net_create();
  can_net_set_send_func(net, &send_frame, bus);
  timespec_get(&now, TIME_UTC);
  can_net_set_time(net, &now);
  next = now;
  can_net_set_next_func(net, &next_time, &next);
  co_dev_t *dev = co_dev_create_from_dcf_file(argv[2]);
  if (!dev) return 4;
  co_nmt_t *nmt = co_nmt_create(net, dev);
  co_nmt_set_sync_ind(nmt, &on_sync, dev);
  if (co_nmt_cs_ind(nmt, CO_NMT_CS_RESET_NODE)) return 5;
  puts("ready");
  fflush(stdout);
  for (;;) {
    struct can_msg msg = CAN_MSG_INIT;
    int64_t wait = timespec_diff_msec(&next, &now);
    io_poll_wait(poll, 1, &event, wait < 0 || wait > 20 ? 20 : (int)wait);
    timespec_get(&now, TIME_UTC);
    can_net_set_time(net, &now);
    if (timespec_cmp(&next, &now) < 0) { next = now; timespec_add_msec(&next, 20); }
    while (io_can_read(bus, &msg) == 1) {
      can_net_recv(net, &msg);
      /* The stack leaves it to its user to begin with the node id that LSS has given to a device without one. */
      if (msg.id == 0x7E5 && msg.data[0] == 4 && msg.data[1] == 0 && co_dev_get_id(dev) == 255 && co_nmt_get_id(nmt) != 255)
        co_nmt_cs_ind(nmt, CO_NMT_CS_RESET_COMM);
    }
  }
}
"""


def build(folder, scratch):
    """The program, from folder/lely-core/install."""
    install = folder / "lely-core" / "install"
    if not (install / "lib" / "liblely-co.a").is_file():
        raise SystemExit(f"there is no {install}/lib/liblely-co.a: configure lely-core with --prefix={install}, then make install")
    scratch.mkdir()
    (scratch / "drive.c").write_text(PROGRAM)
    program = scratch / "lely-drive"
    libraries = [str(install / "lib" / f"liblely-{one}.a") for one in ("co", "io", "can", "util", "libc")]
    subprocess.run(["gcc", "-O1", "-w", f"-I{install}/include", str(scratch / "drive.c"), *libraries, "-lpthread", "-lm", "-o", str(program)],
                   check=True)
    return pathlib.Path(program)
