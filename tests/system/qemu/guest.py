#!/usr/bin/env python3
"""A small Linux guest under QEMU: a Debian kernel, an initrd made of a few files, a serial console.

As a program:
  guest.py kernel FOLDER [PACKAGE]   fetch Debian's kernel and unpack it there (once)
As a module: kernel(), Initrd, Guest.

The default kernel is Debian's for virtual machines, which is the smallest. `linux-image-amd64` has
everything else, such as the modules of SocketCAN.
"""

import os
import pathlib
import re
import selectors
import shutil
import stat
import subprocess
import sys
import tempfile
import time

DEFAULT_PACKAGE = "linux-image-cloud-amd64"


def run(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


class Kernel:
    """An unpacked kernel package."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        images = sorted(self.folder.glob("boot/vmlinuz-*"))
        if not images:
            raise SystemExit(f"there is no kernel in {folder}")
        self.image = images[-1]
        release = self.image.name.removeprefix("vmlinuz-")
        modules = self.folder / "lib" / "modules" / release
        if not modules.exists():
            modules = self.folder / "usr" / "lib" / "modules" / release
        self.modules = {
            path.name.removesuffix(".ko").replace("-", "_"): path for path in modules.rglob("*.ko")
        }

    def with_dependencies(self, names):
        """The files of modules and of what they need, in the order of loading. Names that are no
        modules are built in."""
        order = []

        def add(name):
            path = self.modules.get(name.replace("-", "_"))
            if path is None or path in order:
                return
            depends = re.search(rb"\0depends=([^\0]*)\0", path.read_bytes())
            for needed in (depends.group(1).decode().split(",") if depends else []):
                if needed:
                    add(needed)
            order.append(path)

        for name in names:
            add(name)
        return order


def kernel(folder, package=DEFAULT_PACKAGE):
    """Fetches and unpacks a Debian kernel; does nothing when it is there."""
    folder = pathlib.Path(folder) / package
    done = folder / "done"
    if not done.exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        # The package depends on the one with the version in its name.
        depends = run("apt-cache", "depends", package)
        real = re.search(r"Depends: (linux-image-\d\S+)", depends)
        name = real.group(1) if real else package
        with tempfile.TemporaryDirectory(dir=folder) as scratch:
            os.chmod(scratch, 0o777)  # apt downloads as a user of its own
            try:
                run("apt-get", "download", name, cwd=scratch)
            except subprocess.CalledProcessError as error:
                raise SystemExit(f"the kernel cannot be fetched:\n{error.stderr}") from error
            for archive in pathlib.Path(scratch).glob("*.deb"):
                run("dpkg", "-x", str(archive), str(folder))
        done.touch()
    return Kernel(folder)


class Initrd:
    """A cpio archive (format newc)."""

    def __init__(self):
        self.entries = []
        self.folders = set()

    def _add(self, name, mode, data=b"", device=(0, 0)):
        self.entries.append((name, mode, data, device))

    def folder(self, name):
        parts = name.strip("/").split("/")
        for i in range(1, len(parts) + 1):
            part = "/".join(parts[:i])
            if part not in self.folders:
                self.folders.add(part)
                self._add(part, stat.S_IFDIR | 0o755)

    def file(self, name, data, executable=False):
        name = name.strip("/")
        if "/" in name:
            self.folder(name.rsplit("/", 1)[0])
        if isinstance(data, str):
            data = data.encode()
        self._add(name, stat.S_IFREG | (0o755 if executable else 0o644), data)

    def device(self, name, major, minor):
        self.folder(name.strip("/").rsplit("/", 1)[0])
        self._add(name.strip("/"), stat.S_IFCHR | 0o600, device=(major, minor))

    def write(self, path):
        out = bytearray()

        def pad():
            out.extend(b"\0" * (-len(out) % 4))

        for number, (name, mode, data, device) in enumerate(
            self.entries + [("TRAILER!!!", 0, b"", (0, 0))], start=1
        ):
            fields = [number, mode, 0, 0, 1, 0, len(data), 0, 0, *device, len(name) + 1, 0]
            out += b"070701" + "".join(f"{field:08X}" for field in fields).encode()
            out += name.encode() + b"\0"
            pad()
            out += data
            pad()
        pathlib.Path(path).write_bytes(out)


def busybox_initrd(guest_kernel, modules, commands, files=()):
    """An initrd whose shell loads the modules, runs the commands, and switches the machine off.
    `files`: pairs of a name in the guest and a path; they are executable."""
    initrd = Initrd()
    for folder in ("proc", "sys", "dev", "data", "bin", "tmp"):
        initrd.folder(folder)
    initrd.device("dev/console", 5, 1)
    initrd.file("bin/busybox", pathlib.Path("/bin/busybox").read_bytes(), executable=True)
    script = ["#!/bin/busybox sh", "export PATH=/bin", "/bin/busybox --install -s /bin"]
    script += ["mount -t proc proc /proc", "mount -t sysfs sys /sys", "mount -t devtmpfs dev /dev"]
    for path in guest_kernel.with_dependencies(modules):
        initrd.file(f"modules/{path.name}", path.read_bytes())
        script.append(f"insmod /modules/{path.name}")
    script += list(commands) + ["poweroff -f"]
    initrd.file("init", "\n".join(script) + "\n", executable=True)
    for name, path in files:
        initrd.file(name, pathlib.Path(path).read_bytes(), executable=True)
    return initrd


class Guest:
    """A running guest; what it writes to its console comes line by line."""

    def __init__(self, guest_kernel, initrd, disk=None, arguments="", memory=192):
        self.buffer = b""
        self.log = []
        command = ["qemu-system-x86_64", "-accel", "tcg", "-cpu", "max", "-m", str(memory)]
        command += ["-nodefaults", "-no-reboot", "-nographic", "-serial", "stdio"]
        command += ["-kernel", str(guest_kernel.image), "-initrd", str(initrd)]
        # An exit of init is a panic; -no-reboot makes it the end of the guest.
        command += ["-append", f"console=ttyS0 quiet panic=-1 tsc=reliable {arguments}"]
        if disk is not None:
            command += ["-drive", f"file={disk},format=raw,if=virtio,cache=writeback"]
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
        os.set_blocking(self.process.stdout.fileno(), False)
        self.selector = selectors.DefaultSelector()
        self.selector.register(self.process.stdout, selectors.EVENT_READ)

    def lines(self, seconds):
        """Lines as they come, until the guest ends or the time is over. The last one may be cut."""
        end = time.monotonic() + seconds
        while True:
            while b"\n" in self.buffer:
                line, self.buffer = self.buffer.split(b"\n", 1)
                text = line.decode(errors="replace").strip("\r")
                self.log.append(text)
                yield text
            left = end - time.monotonic()
            if left <= 0 or not self.selector.select(left):
                return
            data = self.process.stdout.read()
            if not data:
                self.process.wait()
                return
            self.buffer += data

    def wait_for(self, pattern, seconds):
        """The match in the first line that has one; raises with the console's text without."""
        for line in self.lines(seconds):
            found = re.search(pattern, line)
            if found:
                return found
        raise RuntimeError(f"no '{pattern}' on the console:\n" + "\n".join(self.log[-40:]))

    def kill(self):
        """As when the power fails."""
        self.process.kill()
        self.process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.kill()


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] != "kernel":
        raise SystemExit(__doc__)
    print(kernel(*sys.argv[2:4]).image)
