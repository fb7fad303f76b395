#!/usr/bin/env python3
"""Hard kills of a guest that saves retained data: nothing that was acknowledged is ever lost.

usage: retain_kills.py KERNEL_FOLDER WRITER [KILLS]
"""

import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import time

import guest

BOOT_SECONDS = 180


def check_one(number, kernel, initrd, folder, kills, failures):
    disk = pathlib.Path(folder) / f"disk{number}"
    with open(disk, "wb") as file:
        file.truncate(24 << 20)
    subprocess.run(["/sbin/mkfs.ext4", "-q", "-F", str(disk)], check=True)
    dice = random.Random(number)
    safe = 0
    saves = 0
    for kill in range(kills + 1):
        with guest.Guest(kernel, initrd, disk=disk) as machine:
            found = int(machine.wait_for(r"found (\d+) end", BOOT_SECONDS).group(1))
            if found < safe:
                failures.append(f"guest {number}, kill {kill}: {safe} was safe, {found} is there")
            safe = found
            machine.wait_for(r"safe \d+ end", BOOT_SECONDS)
            end = time.monotonic() + dice.uniform(0.02, 1.0)
            while (left := end - time.monotonic()) > 0:
                for line in machine.lines(left):
                    if done := re.search(r"safe (\d+) end", line):
                        safe = int(done.group(1))
                        saves += 1
            machine.kill()
            bad = [line for line in machine.log if re.search("problem|torn|EXT4-fs error", line)]
            failures.extend(f"guest {number}, kill {kill}: {line}" for line in bad)
    print(f"guest {number}: {kills + 1} kills, generation {safe}, {saves} saves seen")


def main():
    kernel_folder, writer = sys.argv[1:3]
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    kernel = guest.kernel(kernel_folder)
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        initrd = pathlib.Path(folder) / "initrd"
        guest.busybox_initrd(
            kernel,
            ["virtio_pci", "virtio_blk", "ext4"],
            ["mount -t ext4 /dev/vda /data", "exec /bin/writer /data/retain"],
            [("bin/writer", writer)],
        ).write(initrd)
        results = []

        def guarded(thread_index):
            try:
                check_one(thread_index, kernel, initrd, folder, (kills + 1) // 2, failures)
                results.append(thread_index)
            except RuntimeError as error:
                failures.append(f"guest {thread_index}: {error}")

        threads = [threading.Thread(target=guarded, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    for failure in failures:
        print(failure)
    sys.exit(1 if failures or len(results) != 2 else 0)


main()
