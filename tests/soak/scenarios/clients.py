"""Storms of clients on the socket of a run: good, wrong, silent and vanishing ones. The axes go on, whoever asks properly is
answered, memory and descriptors come back. What clients have written is in the recording of a run."""
import json
import random
import socket
import threading
import time

import client
import invariants
import motion
from replay import replays
from frame import wait_until

ARRAYS = "PROGRAM Heap\nVAR rows : ARRAY[0..1999] OF DINT; w : LREAL; s : STRING(80); END_VAR\nrows[0] := rows[0] + 1;\nEND_PROGRAM\n"
PRINTED = "GVL.cycles,PLC_PRG,Heap"
NAMES = ["GVL.cycles", "Heap.rows", "Heap.w", "Heap.s", "PLC_PRG", "X0.fSetPosition", "X0", "nothing", "Heap.rows[5]", "Heap.rows[5000]", "", "PLC_PRG.mX0.one"]
OPS = ["read", "write", "force", "unforce", "forces", "list", "subscribe", "unsubscribe", "tasks", "statistics", "state", "record", "record_state",
       "record_stop", "record_read", "online_change", "nonsense"]
WRITABLE = [("Heap.w", "1.5"), ("Heap.s", "'x'"), ("Heap.rows[7]", "-3"), ("Heap.w", "'x'"), ("Heap.rows", "1"), ("Heap.s", "'" + "y" * 200 + "'")]


def some_request(rng):
    """A request that may be right"""
    op = rng.choice(OPS)
    request = {"id": rng.choice([rng.randrange(1000), "text", None, -1, 2**70, 1.5]), "op": op}
    names = [rng.choice(NAMES) for _ in range(rng.choice([1, 1, 2, 5, 300]))]
    if rng.random() < 0.9:
        request["names"] = names
    if op in ("write", "force"):
        request["values"] = [dict(zip(("name", "literal"), rng.choice(WRITABLE))) for _ in range(rng.choice([0, 1, 3]))]
    request.update(rng.choice([{}, {"all": True}, {"path": rng.choice(NAMES), "limit": rng.choice([-1, 0, 5, 10**9])}, {"period": rng.choice([0.01, -1, 1e308, "x"])},
                               {"rows": rng.choice([1, 100, 10**12, -5]), "before": rng.choice([0, 0.5, 7])}, {"from": rng.choice([-1, 0, 10**15]), "count": 10},
                               {"subscription": rng.randrange(5)}, {"app": rng.choice(["Soak", "Other", 5])}, {"literals": True},
                               {"trigger": {"name": rng.choice(NAMES), "edge": rng.choice(["rising", "up"]), "threshold": 3}}]))
    return json.dumps(request).encode() + b"\n"


def nonsense(rng):
    """A line that is none, or is wrong JSON"""
    good = some_request(rng)
    return rng.choice([
        lambda: good[:rng.randrange(len(good))] + b"\n", lambda: bytes(rng.randrange(256) for _ in range(rng.randrange(200))) + b"\n",
        lambda: b"[" * rng.choice([10, 1000, 100000]) + b"\n", lambda: b'{"id":1,"op":"read","names":[' + b'"Heap.w",' * 5000 + b'"Heap.w"]}\n',
        lambda: b"\n" * rng.randrange(1000), lambda: b'{"id":1,"id":2,"op":"' + b"x" * rng.choice([10, 300000]) + b'"}\n', lambda: b"\0" * 50 + b"\n",
        lambda: good.replace(b":", b"::"), lambda: b'"\\ud800"\n', lambda: b"1e999999\n", lambda: good[:-1]])()


def misbehave(path, seed, end):
    """One client after the other until the time is over; how many there were, and how many lines"""
    rng = random.Random(seed)
    clients = lines = 0
    while time.monotonic() < end:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
            connection.settimeout(2)
            try:
                connection.connect(path)
                clients += 1
                lines += one_client(rng, connection, end)
            except OSError:
                time.sleep(0.01)
    return clients, lines


def one_client(rng, connection, end):
    kind = rng.choice(["good", "good", "wrong", "silent", "deaf", "mixed"])
    if kind == "silent":
        time.sleep(min(rng.uniform(0, 1), max(0, end - time.monotonic())))
        return 0
    lines = rng.randrange(1, 60)
    for _ in range(lines):
        wrong = kind == "wrong" or (kind == "mixed" and rng.random() < 0.5)
        connection.sendall(nonsense(rng) if wrong else some_request(rng))
        if kind != "deaf" and rng.random() < 0.7:
            connection.recv(rng.choice([1, 100, 65536]))
        if time.monotonic() > end:
            break
    if rng.random() < 0.3:
        connection.sendall(b'{"id":1,"op"')  # half a line, and gone
    return lines


def play(round_):
    rng = round_.rng
    project = motion.MotionProject(rng, axes=rng.randint(1, 3), interval_ms=rng.choice([1, 2, 5]), extra=ARRAYS)
    more = '\n[[task]]\nname = "Slow"\ninterval = "T#20ms"\npriority = 10\nprograms = ["Heap"]\n'
    folder = project.write(round_.folder / "project", more=more)
    round_.build(folder)
    recording = round_.folder / "run.rec"
    recorded = ["--record", recording] if round_.choose("recorded", rng.random() < 0.3) else []
    run = round_.start(round_.settings.product.host, "run", folder / "build" / "app.so", "--listen", "unix:plc.sock", "--print", PRINTED, *recorded, name="run")
    path = str(round_.folder / "plc.sock")
    client.connect(path, run).close()
    storm(round_, path, 1 if round_.quick else 3)  # what is allocated once is not counted
    quiet(round_, run)
    before = invariants.descriptors(run.pid)
    sizes = []
    for _ in range(1 if round_.quick else round_.choose("storms", rng.randint(2, 5))):
        storm(round_, path, 1 if round_.quick else rng.uniform(2, 5))
        quiet(round_, run)
        round_.demand(run.alive(), f"the run has ended: {run.err[-1500:]}")
        asked_properly(round_, project, path)
        sizes.append(invariants.resident_kib(run.pid))
    round_.choose("resident_kib", sizes)
    # 16 clients at once, with 8 MiB of answers, and recordings
    round_.expect(max(sizes) < 1 << 20, f"a run with storms of clients uses {sizes} KiB")
    nothing_stays(round_, run, path)
    round_.expect(wait_until(lambda: invariants.descriptors(run.pid) == before, 30),
                  f"{before} descriptors were open before the storms, {invariants.descriptors(run.pid)} after")
    run.stop()
    round_.expect(run.code == 0, f"the run ends with exit code {run.code}: {run.err[-1500:]}")
    if figures := invariants.statistics(run.err, "Bus"):
        round_.counts["cycles_run"] += figures[0]
        round_.counts["overruns"] += figures[1]
    if recorded:
        replays(round_, folder / "build" / "app.so", run, recording, PRINTED)


def storm(round_, path, seconds):
    end = time.monotonic() + seconds
    results = []
    count = 2 if round_.quick else round_.rng.randint(2, 20)
    threads = [threading.Thread(target=lambda seed=round_.rng.getrandbits(64): results.append(misbehave(path, seed, end))) for _ in range(count)]
    for thread in threads:
        thread.start()
    for _ in range(0 if round_.quick else 2):
        round_.stride("ctl", f"unix:{path}", *round_.rng.choice([["read", "GVL.cycles"], ["write", "Heap.w=3"], ["force", "Heap.w=5"], ["unforce", "Heap.w"], ["stats"], ["state"]]),
                      timeout=120)
    for thread in threads:
        thread.join()
    round_.expect(len(results) == count, "a client of the soak itself failed")
    round_.counts["clients"] += sum(c for c, _ in results)
    round_.counts["lines"] += sum(n for _, n in results)


ALIKE = [b'{"id":1,"op":"read","names":["Heap.rows","GVL.cycles"]}', b'{"id":2,"op":"subscribe","names":["Heap.w","Heap.rows"],"period":0.01}',
         b'{"id":3,"op":"force","values":[{"name":"Heap.w","literal":"5"}]}', b'{"id":4,"op":"unforce","all":true}',
         b'{"id":5,"op":"record","names":["Heap.rows"],"rows":10}', b'{"id":6,"op":"nonsense"', b'{"id":7,"op":"li']


def nothing_stays(round_, run, path):
    """Clients that all do the same, one after the other, cost no memory once there were some."""
    def some(count):
        for _ in range(count):
            with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
                connection.settimeout(60)
                connection.connect(path)
                connection.sendall(b"\n".join(ALIKE))
                answers = b""
                while b'"id":5' not in answers:
                    answer = connection.recv(1 << 16)
                    round_.demand(answer, f"the server has hung up on a client that asks a few things: {answers[-300:]}")
                    answers += answer
        quiet(round_, run)
        return invariants.resident_kib(run.pid)

    count = 20 if round_.quick else 300
    some(count)
    before = some(count)
    after = some(2 * count)
    round_.counts["clients"] += 4 * count
    round_.choose("alike_kib", [before, after])
    round_.expect(after - before < 1024, f"{2 * count} clients that do the same have cost {after - before} KiB; before they used {before} KiB")


def quiet(round_, run):
    """Until the server has noticed that all clients are gone"""
    def settled():
        count = invariants.descriptors(run.pid)
        time.sleep(0.2)
        return count == invariants.descriptors(run.pid)
    if run.alive():
        wait_until(settled, 10)


def asked_properly(round_, project, path):
    with client.Client(path) as good:
        good.ask("unforce", all=True)
        good.write(**{"Heap.w": "2.5"})
        first = good.read("GVL.cycles", "Heap.w", "Heap.rows[0]")
        round_.expect(first["Heap.w"] == 2.5, f"Heap.w was written with 2.5 and is {first['Heap.w']}")
        round_.expect(wait_until(lambda: good.read("GVL.cycles")["GVL.cycles"] > first["GVL.cycles"], 30), "the program's cycles stand still")
        names = [f"PLC_PRG.m{a.name}.{v}" for a in project.axes for v in ("maxStep", "maxChange", "errors")]
        invariants.movers_within_limits(round_, project, good.read(*names), "during storms of clients")
