#!/usr/bin/env python3
"""Runs a shell script in a guest whose kernel has SocketCAN, with programs of this machine.

usage: can_guest.py KERNELS [options] SCRIPT [FILE[:NAME] …]

  --vcan N       virtual buses vcan0 … (default 1)
  --wire BPS     they take as long as a wire of so many bits a second (128 bits a frame), with a queue of 64 frames
  --can N        interfaces can0 … of emulated SJA1000 controllers on one bus, up at 1 Mbit/s
  --out FOLDER   what the script leaves in /out comes there
  --timeout S    default 120

SCRIPT is text for the guest's shell; programs of FILE bring the libraries that they are linked with and are in /bin. (Where busybox has a command of that name, its shell takes
its own: /bin/ip, not ip.)
Time is the guest's own: it counts instructions and jumps over idle time, so that a task of 1 ms is on time however busy
this machine is. The script's output and exit status are those of this program; 125: the guest has failed.
"""

import argparse
import io
import lzma
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import guest

PACKAGE = "linux-image-amd64"  # the kernel for virtual machines has no CAN
MODULES = ["can", "can_raw", "vcan", "virtio_pci", "virtio_console"]
TOOLS = ["ip", "tc", "candump", "cansend", "cangen", "canplayer"]
PLACES = os.environ["PATH"] + ":/usr/sbin:/sbin"
# Nanoseconds per instruction are 2 to the power of this.
ICOUNT = "shift=1,sleep=off,align=off"


def elf_of(kernel):
    """The kernel unpacked, which QEMU starts at once: the guest need not unpack it."""
    elf = kernel.image.with_name(kernel.image.name.replace("vmlinuz", "vmlinux"))
    if not elf.exists():
        data = kernel.image.read_bytes()
        begin = data.find(b"\xfd7zXZ\x00")
        if begin < 0:
            return kernel.image
        part = elf.with_suffix(f".{os.getpid()}")
        part.write_bytes(lzma.LZMADecompressor().decompress(data[begin:]))
        part.rename(elf)
    return elf


def libraries_of(program):
    """What the loader maps for a program, and the loader."""
    said = subprocess.run(["ldd", program], capture_output=True, text=True, check=False)
    if said.returncode != 0:
        return []  # it is static
    words = [line.split() for line in said.stdout.splitlines()]
    paths = [w[2] if len(w) > 2 and w[1] == "=>" else w[0] for w in words if w]
    return [path for path in paths if path.startswith("/")]


class Content:
    """Files of the guest, each once."""

    def __init__(self):
        self.initrd = guest.Initrd()
        self.names = set()
        for folder in ("proc", "sys", "dev", "tmp", "out", "etc", "bin"):
            self.initrd.folder(folder)
        self.initrd.device("dev/console", 5, 1)
        self.add("/bin/busybox", "/bin/busybox")

    def add(self, path, name):
        if name in self.names:
            return
        self.names.add(name)
        if os.path.isdir(path):
            self.initrd.folder(name)
            for entry in sorted(os.listdir(path)):
                self.add(os.path.join(path, entry), os.path.join(name, entry))
            return
        data = pathlib.Path(path).read_bytes()
        self.initrd.file(name, data, executable=bool(os.stat(path).st_mode & stat.S_IXUSR))
        if data.startswith(b"\x7fELF"):
            for library in libraries_of(path):
                self.add(library, library)


def interfaces(options):
    """The commands that set up the buses."""
    lines = ["/bin/ip link set lo up"]
    for i in range(options.vcan):
        lines.append(f"/bin/ip link add dev vcan{i} type vcan")
        lines.append(f"/bin/ip link set vcan{i} mtu {16 if options.wire else 72} txqueuelen 64 up")
        if options.wire:
            lines.append(f"/bin/tc qdisc replace dev vcan{i} root tbf rate {options.wire}bit burst 16 limit 1024")
    for i in range(options.can):
        lines.append(f"/bin/ip link set can{i} type can bitrate 1000000 restart-ms 100")
        lines.append(f"/bin/ip link set can{i} txqueuelen 128 up")
    return lines


def content(options, kernel):
    """The initrd: its init runs the script and sends back what it has left."""
    files = Content()
    for tool in TOOLS:
        path = shutil.which(tool, path=PLACES)
        if path is None:
            raise SystemExit(f"{tool} is missing: apt-get install iproute2 can-utils")
        files.add(path, f"/bin/{tool}")
    for item in options.files:
        path, _, name = item.partition(":")
        files.add(path, name or f"/bin/{os.path.basename(path)}")
    init = [
        "#!/bin/busybox sh",
        "export PATH=/bin HOME=/tmp",
        "for a in $(/bin/busybox --list); do [ -e /bin/$a ] || ln -s /bin/busybox /bin/$a; done",
        "mount -t proc proc /proc; mount -t sysfs sys /sys; mount -t devtmpfs dev /dev",
        "mkdir -p /dev/shm; mount -t tmpfs shm /dev/shm; mount -t tmpfs tmp /tmp",
    ]
    wanted = MODULES + (["sch_tbf"] if options.wire else []) + (["kvaser_pci"] if options.can else [])
    for path in kernel.with_dependencies(wanted):
        files.initrd.file(f"modules/{path.name}", path.read_bytes())
        # With a wire, frames come back to their sender after the queue, as from a controller.
        echo = " echo=1" if options.wire and path.name == "vcan.ko" else ""
        init.append(f"insmod /modules/{path.name}{echo}")
    init += interfaces(options)
    files.initrd.file("script", options.script)
    init += [
        "cd /tmp; /bin/sh /script < /dev/null > /out/.text 2>&1",
        "echo $? > /out/.status",
        "tar -c -f - -C /out . > /dev/vport0p1",
        "poweroff -f",
    ]
    files.initrd.file("init", "\n".join(init) + "\n", executable=True)
    return files.initrd


def command(options, image, initrd, console, result):
    words = ["qemu-system-x86_64", "-accel", "tcg", "-cpu", "max", "-m", "256"]
    words += ["-nodefaults", "-no-reboot", "-nographic", "-no-user-config"]
    words += ["-kernel", str(image), "-initrd", str(initrd), "-serial", f"file:{console}"]
    words += ["-icount", ICOUNT, "-rtc", "clock=vm,base=2026-01-01", "-seed", "1"]
    words += ["-device", "virtio-serial-pci", "-chardev", f"file,id=result,path={result}"]
    words += ["-device", "virtserialport,chardev=result,nr=1"]
    if options.can:
        words += ["-object", "can-bus,id=bus"]
    for _ in range(options.can):
        words += ["-device", "kvaser_pci,canbus=bus"]
    return words + ["-append", "console=ttyS0 quiet loglevel=1 panic=-1 tsc=reliable no_timer_check mitigations=off "
                    "nokaslr norandmaps audit=0 selinux=0 apparmor=0 random.trust_cpu=on"]


def run(options):
    """The output and the exit status of the script in a guest."""
    kernel = guest.kernel(options.kernels, PACKAGE)
    image = elf_of(kernel)
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        content(options, kernel).write(scratch / "initrd")
        words = command(options, image, scratch / "initrd", scratch / "console", scratch / "result")
        try:
            subprocess.run(words, stdin=subprocess.DEVNULL, timeout=options.timeout, check=False)
        except subprocess.TimeoutExpired:
            pass  # there is no result then
        result = scratch / "result"
        if not result.exists() or result.stat().st_size == 0:
            console = (scratch / "console").read_text(errors="replace")
            return f"the guest has brought no result in {options.timeout} s:\n{console[-4000:]}", 125
        text, status = "", 125
        with tarfile.open(fileobj=io.BytesIO(result.read_bytes())) as archive:
            for member in archive:
                if not member.isfile():
                    continue
                name, data = member.name.removeprefix("./"), archive.extractfile(member).read()
                if name == ".text":
                    text = data.decode(errors="replace")
                elif name == ".status":
                    status = int(data)
                elif options.out:
                    target = pathlib.Path(options.out) / name
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(data)
        return text, status


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("kernels")
    parser.add_argument("--vcan", type=int, default=1)
    parser.add_argument("--wire", type=int, default=0)
    parser.add_argument("--can", type=int, default=0)
    parser.add_argument("--out")
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("script")
    parser.add_argument("files", nargs="*")
    text, status = run(parser.parse_args())
    sys.stdout.write(text)
    sys.exit(status)


if __name__ == "__main__":
    main()
