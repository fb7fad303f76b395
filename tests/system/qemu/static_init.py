#!/usr/bin/env python3
"""A static executable is the only program of a machine: the kernel starts it as init.

usage: static_init.py KERNEL_FOLDER STRIDE PROJECT
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

import guest


def main():
    kernel_folder, stride, project = sys.argv[1:4]
    kernel = guest.kernel(kernel_folder)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copytree(project, folder / "project", ignore=shutil.ignore_patterns("build"))
        program = folder / "program"
        subprocess.run(
            [stride, "build", str(folder / "project"), "--static", "-o", str(program)], check=True
        )
        simulation = ["sim", "--for", "5s", "--print", "Drive.fSetPosition"]
        here = subprocess.run(
            [program, *simulation], check=True, capture_output=True, text=True
        ).stdout.strip()
        initrd = guest.Initrd()
        initrd.folder("dev")
        initrd.device("dev/console", 5, 1)
        initrd.file("init", program.read_bytes(), executable=True)
        initrd.write(folder / "initrd")
        with guest.Guest(kernel, folder / "initrd", arguments="-- " + " ".join(simulation)) as machine:
            there = machine.wait_for(r"Drive\.fSetPosition = .*", 180).group(0).strip()
        print(f"here: {here}, as init: {there}")
        sys.exit(0 if here == there else 1)


main()
