#!/usr/bin/env python3
"""Builds a device of CiA 401 from checkouts of CANopenNode and CANopenLinux: its inputs are its outputs, inverted.

As a module: build(). The example's object dictionary gets 6000h and 6200h to 6207h of one byte; nothing of the stack is changed.
"""

import pathlib
import shutil
import subprocess

STACK = ["301/CO_ODinterface.c", "301/CO_NMT_Heartbeat.c", "301/CO_HBconsumer.c", "301/CO_Emergency.c", "301/CO_SDOserver.c",
         "301/CO_SDOclient.c", "301/CO_TIME.c", "301/CO_SYNC.c", "301/CO_PDO.c", "301/crc16-ccitt.c", "301/CO_fifo.c",
         "303/CO_LEDs.c", "304/CO_GFC.c", "304/CO_SRDO.c", "305/CO_LSSslave.c", "305/CO_LSSmaster.c", "309/CO_gateway_ascii.c",
         "storage/CO_storage.c", "extra/CO_trace.c", "CANopen.c"]
LINUX = ["CO_driver.c", "CO_error.c", "CO_epoll_interface.c", "CO_storageLinux.c", "CO_main_basic.c"]
OBJECTS = ((0x6000, "ODA_SDO_R | ODA_TPDO"), (0x6200, "ODA_SDO_RW | ODA_RPDO"), (0x6206, "ODA_SDO_RW"), (0x6207, "ODA_SDO_RW"))
VENDOR, PRODUCT, REVISION, SERIAL = 0x2AB, 0x31, 7, 4713

APPLICATION = """
#include "CO_application.h"
#include "OD.h"
extern uint8_t terminal_6000, terminal_6200;
CO_ReturnError_t app_programStart(uint16_t *bitRate, uint8_t *nodeId, uint32_t *errInfo) {
  (void)bitRate; (void)nodeId; (void)errInfo;
  return CO_ERROR_NO;
}
void app_communicationReset(CO_t *co) { (void)co; }
void app_programEnd() {}
void app_programAsync(CO_t *co, uint32_t us) { /* the only one that a program of one thread calls */
  (void)co; (void)us;
  terminal_6000 = (uint8_t)~terminal_6200;
}
void app_programRt(CO_t *co, uint32_t us) { (void)co; (void)us; }
"""


def dictionary(text):
    """The example's dictionary with the objects of the device and its identity."""
    before, entries = "", ""
    for index, attribute in OBJECTS:
        name = f"terminal_{index:04X}"
        before += f"static uint8_t {name}_count = 1;\nuint8_t {name} = 0;\n"
        before += (f"static OD_obj_array_t {name}_object = {{.dataOrig0 = &{name}_count, .dataOrig = &{name}, .attribute0 = ODA_SDO_R, "
                   f".attribute = {attribute}, .dataElementLength = 1, .dataElementSizeof = 1}};\n")
        entries += f"    {{0x{index:04X}, 0x02, ODT_ARR, &{name}_object, NULL}},\n"
    replaced = (("static OD_ATTR_OD OD_entry_t ODList[] = {", before + "static OD_ATTR_OD OD_entry_t ODList[] = {"),
                ("    {0x0000, 0x00, 0, NULL, NULL}", entries + "    {0x0000, 0x00, 0, NULL, NULL}"),
                (".x1000_deviceType = 0x00000000", ".x1000_deviceType = 0x00030191"),
                (".vendor_ID = 0x00000000", f".vendor_ID = {VENDOR}"), (".productCode = 0x00000000", f".productCode = {PRODUCT}"),
                (".revisionNumber = 0x00000000", f".revisionNumber = {REVISION}"),
                (".serialNumber = 0x00000000", f".serialNumber = {SERIAL}"))
    for old, new in replaced:
        if text.count(old) != 1:
            raise SystemExit(f"CANopenNode's example/OD.c has changed: no single '{old}'")
        text = text.replace(old, new)
    return text


def build(folder, scratch):
    """The program, from folder/CANopenNode and folder/CANopenLinux."""
    stack, linux = folder / "CANopenNode", folder / "CANopenLinux"
    scratch.mkdir()
    (scratch / "OD.c").write_text(dictionary((stack / "example" / "OD.c").read_text()))
    shutil.copy(stack / "example" / "OD.h", scratch)
    (scratch / "application.c").write_text(APPLICATION)
    sources = [str(stack / one) for one in STACK] + [str(linux / one) for one in LINUX]
    sources += [str(scratch / "OD.c"), str(scratch / "application.c")]
    program = scratch / "canopennode"
    subprocess.run(["gcc", "-O1", "-w", "-DCO_SINGLE_THREAD", "-DCO_USE_APPLICATION", f"-I{scratch}", f"-I{linux}", f"-I{stack}", *sources,
                    "-o", str(program)], check=True)
    return pathlib.Path(program)
