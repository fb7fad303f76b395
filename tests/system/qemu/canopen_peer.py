#!/usr/bin/env python3
"""Stride's simulated drives by a master of another maker, and its tools at a node of another maker: the Python package `canopen`.

usage: canopen_peer.py INTERFACE master|slave

In a guest; the package is in PYTHONPATH, without python-can: what it needs of that is here, on a socket of the system.
"""

import socket
import struct
import sys
import threading
import time
import types

FRAME = struct.Struct("=IB3x8s")


class Message:
    def __init__(self, arbitration_id=0, data=b"", is_extended_id=False, is_remote_frame=False, timestamp=0.0):
        self.arbitration_id, self.data, self.timestamp = arbitration_id, bytearray(data or b""), timestamp
        self.is_extended_id, self.is_remote_frame, self.is_error_frame = is_extended_id, is_remote_frame, False


can = types.ModuleType("can")
can.Message = Message
can.Listener = type("Listener", (), {})
can.BusABC = type("BusABC", (), {})
can.Notifier = type("Notifier", (), {})
can.CanError = type("CanError", (Exception,), {})
sys.modules["can"] = can
import canopen  # noqa: E402
from canopen import objectdictionary as od  # noqa: E402


class Bus:
    """A raw CAN socket, whose frames go to a network."""

    def __init__(self, interface, network):
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.bind((interface,))
        self.channel_info = interface
        threading.Thread(target=self.listen, args=(network,), daemon=True).start()

    def send(self, message):
        identifier = message.arbitration_id | (socket.CAN_RTR_FLAG if message.is_remote_frame else 0)
        self.socket.send(FRAME.pack(identifier, len(message.data), bytes(message.data).ljust(8, b"\0")))

    def listen(self, network):
        while True:
            identifier, length, data = FRAME.unpack(self.socket.recv(FRAME.size))
            if not identifier & (socket.CAN_RTR_FLAG | socket.CAN_ERR_FLAG):
                network.notify(identifier, bytearray(data[:length]), time.time())


def variable(index, sub, kind, name=None):
    result = od.ODVariable(name or f"{index:04X}_{sub}", index, sub)
    result.data_type = kind
    result.access_type = "rw"
    result.pdo_mappable = True
    return result


def dictionary():
    result = od.ObjectDictionary()
    u8, u16, u32, i8, i32 = od.UNSIGNED8, od.UNSIGNED16, od.UNSIGNED32, od.INTEGER8, od.INTEGER32
    for index, kind in ((0x1000, u32), (0x1008, od.VISIBLE_STRING), (0x1017, u16), (0x1234, u32), (0x6040, u16), (0x6041, u16),
                        (0x6060, i8), (0x6061, i8), (0x6064, i32), (0x607A, i32), (0x60FF, i32), (0x6083, u32), (0x6502, u32)):
        result.add_object(variable(index, 0, kind))
    identity = od.ODRecord("Identity", 0x1018)
    for sub in range(5):
        identity.add_member(variable(0x1018, sub, u8 if sub == 0 else u32))
    result.add_object(identity)
    for base in (0x1400, 0x1800):
        for number in range(4):
            record = od.ODRecord(f"com{base + number:X}", base + number)
            for sub, kind in ((0, u8), (1, u32), (2, u8), (3, u16), (5, u16)):
                record.add_member(variable(base + number, sub, kind))
            result.add_object(record)
            mapping = od.ODArray(f"map{base + 0x200 + number:X}", base + 0x200 + number)
            for sub in range(9):
                mapping.add_member(variable(base + 0x200 + number, sub, u8 if sub == 0 else u32))
            result.add_object(mapping)
    return result


class Checks:
    def __init__(self):
        self.bad = self.good = 0

    def __call__(self, what, value, expected=True):
        right = bool(expected(value)) if callable(expected) else value == expected
        print("ok" if right else "WRONG", what, "" if right else repr(value), flush=True)
        self.good, self.bad = self.good + right, self.bad + (not right)


def aborts(call):
    try:
        call()
    except canopen.SdoAbortedError as error:
        return error.code
    return None


def configure(node, check):
    """PDOs as a master of that maker sets them."""
    node.nmt.state = "PRE-OPERATIONAL"
    node.tpdo.read()
    node.rpdo.read()
    for number in range(1, 5):
        node.tpdo[number].enabled = node.rpdo[number].enabled = number == 1
    for pdo, objects in ((node.tpdo[1], (0x6041, 0x6064)), (node.rpdo[1], (0x6040, 0x607A))):
        pdo.clear()
        for index in objects:
            pdo.add_variable(index)
        pdo.trans_type = 1 if pdo is node.tpdo[1] else 255  # the package sends RPDOs by itself only so
    node.tpdo.save()
    node.rpdo.save()
    check("1A00h:1 is the statusword", node.sdo[0x1A00][1].raw, 0x60410010)
    check("1600h:2 is the target position", node.sdo[0x1600][2].raw, 0x607A0020)
    check("1800h:2 is the type", node.sdo[0x1800][2].raw, 1)


def drive(network, node, check):
    """Through the states of CiA 402 to operation, and to a position in steps of SYNC."""
    node.setup_402_state_machine()
    node.nmt.state = "OPERATIONAL"
    network.sync.start(0.005)
    node.op_mode = "CYCLIC SYNCHRONOUS POSITION"
    check("mode of operation", node.op_mode, "CYCLIC SYNCHRONOUS POSITION")
    check("modes that it supports", node.is_op_mode_supported("HOMING"))
    node.rpdo[1][0x607A].raw = node.sdo[0x6064].raw
    for state in ("READY TO SWITCH ON", "SWITCHED ON", "OPERATION ENABLED"):
        node.state = state
        check(f"state {state}", node.state, state)
    begin = node.sdo[0x6064].raw
    for step in range(1, 101):
        node.rpdo[1][0x607A].raw = begin + 20 * step
        node.rpdo[1].transmit()
        node.tpdo[1].wait_for_reception(0.2)
    time.sleep(0.05)
    check("it has come to its target", abs(node.sdo[0x6064].raw - begin - 2000), lambda away: away <= 20)
    check("the PDO says so", abs(node.tpdo[1][0x6064].raw - begin - 2000), lambda away: away <= 20)
    node.state = "SWITCH ON DISABLED"
    check("it is off", node.state, "SWITCH ON DISABLED")
    network.sync.stop()


def as_master(interface):
    check = Checks()
    network = canopen.Network()
    network.bus = Bus(interface, network)
    task = SendPeriodic(network)
    network.bus.send_periodic = task.start
    node = canopen.BaseNode402(1, dictionary())
    network.add_node(node)
    node.nmt.state = "RESET"
    node.nmt.wait_for_bootup(2)
    check("it boots", node.nmt.state, lambda state: state in ("PRE-OPERATIONAL", "INITIALISING"))
    check("device type", node.sdo[0x1000].raw & 0xFFFF, 402)
    check("a text by segments", node.sdo[0x1008].raw, lambda text: "Stride" in text)
    with node.sdo[0x1008].open("rb", block_transfer=True) as file:
        check("the same by blocks", b"Stride" in file.read())
    check("an object that is not there", aborts(lambda: node.sdo[0x1234].raw), 0x06020000)
    node.sdo[0x6083].raw = 123456
    check("a value is kept", node.sdo[0x6083].raw, 123456)
    check("a read-only object", aborts(lambda: node.sdo.download(0x6041, 0, b"\1\0")), 0x06010002)
    check("a value that is too long", aborts(lambda: node.sdo.download(0x6083, 0, b"12345678")), lambda code: code)
    node.sdo[0x1017].raw = 50
    node.nmt.wait_for_heartbeat(1)
    check("heartbeat", node.nmt.state, "PRE-OPERATIONAL")
    configure(node, check)
    drive(network, node, check)
    network.scanner.search(5)
    time.sleep(0.3)
    check("a scan finds both", sorted(network.scanner.nodes), [1, 2])
    return check


class SendPeriodic:
    """Of python-can: a frame again and again."""

    def __init__(self, network):
        self.network = network

    def start(self, message, period):
        runs = threading.Event()
        runs.set()

        def run():
            while runs.is_set():
                self.network.bus.send(message)
                time.sleep(period)

        threading.Thread(target=run, daemon=True).start()
        return types.SimpleNamespace(stop=runs.clear)


def as_slave(interface):
    """A node of that maker until somebody writes 2000h:0 := 99 in it."""
    network = canopen.Network()
    network.bus = Bus(interface, network)
    objects = dictionary()
    for index, kind in ((0x2000, od.INTEGER16), (0x2001, od.DOMAIN)):
        objects.add_object(variable(index, 0, kind))
    objects[0x1000].default = 0x00020192
    objects[0x2000].default = -5
    node = canopen.LocalNode(10, objects)
    network.add_node(node)
    node.sdo[0x1008].raw = "A node that is not Stride's, with a name of more than a segment"
    for sub, value in enumerate((4, 0x1AB, 0x22, 3, 4711)):
        node.sdo[0x1018][sub].raw = value
    print("ready", flush=True)
    for _ in range(2000):
        if node.sdo[0x2000].raw == 99:
            return
        time.sleep(0.01)


def main():
    if sys.argv[2] == "slave":
        as_slave(sys.argv[1])
        return
    check = as_master(sys.argv[1])
    print(check.good, "good,", check.bad, "wrong")
    sys.exit(check.bad != 0)


if __name__ == "__main__":
    main()
