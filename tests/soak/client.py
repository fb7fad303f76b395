"""A client of `stride run --listen` that keeps to the protocol (docs/monitor.md)."""
import json
import socket
import time


class Refused(Exception):
    """The server answered with an error; its code and message."""

    def __init__(self, error):
        super().__init__(f"{error.get('code')}: {error.get('message')}")
        self.code = error.get("code")


class Gone(Exception):
    """The server has hung up or does not answer in time."""


class Client:
    def __init__(self, path, timeout=60):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(timeout)
        self.buffer, self.number = b"", 0
        try:
            self.socket.connect(str(path))
            self.hello = self.line()
        except OSError as problem:
            self.close()
            raise Gone(str(problem)) from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.socket.close()

    def line(self):
        while b"\n" not in self.buffer:
            try:
                got = self.socket.recv(65536)
            except OSError as problem:
                raise Gone(str(problem) or "no answer") from None
            if not got:
                raise Gone("hung up")
            self.buffer += got
        text, self.buffer = self.buffer.split(b"\n", 1)
        return json.loads(text)

    def ask(self, op, **fields):
        """The result of a request, which is asked again when an online change came between. Raises Refused, Gone."""
        for _ in range(100):
            try:
                return self.ask_once(op, **fields)
            except Refused as refused:
                if refused.code != "gone":
                    raise
                time.sleep(0.05)
        return self.ask_once(op, **fields)

    def ask_once(self, op, **fields):
        self.number += 1
        try:
            self.socket.sendall(json.dumps({"id": self.number, "op": op, **fields}).encode() + b"\n")
        except OSError as problem:
            raise Gone(str(problem)) from None
        while True:
            answer = self.line()
            if answer.get("id") == self.number:
                break
        if "error" in answer:
            raise Refused(answer["error"])
        return answer["result"]

    def read(self, *names, literals=False):
        """The values by name."""
        result = self.ask("read", names=list(names), literals=literals)
        return {entry["name"]: entry["value"] for entry in result["values"]}

    def write(self, **literals):
        self.ask("write", values=[{"name": name, "literal": literal} for name, literal in literals.items()])


def connect(path, process, seconds=60):
    """A client of a run that is just starting."""
    end = time.monotonic() + seconds
    while True:
        try:
            return Client(path)
        except Gone:
            if time.monotonic() > end or not process.alive():
                raise
            time.sleep(0.02)
