"""A serial line made of software that can be damaged: bytes between two pseudo-terminals."""

import os
import pty
import select
import threading
import tty


class SerialLine:
    """Carries bytes between a device (its path) and the process that opens `link`. `damage(bytes)` makes of what the device sends
    what arrives; `pull()` and `plug()` are the connector."""

    def __init__(self, device, link):
        self.link = link
        self.damage = None
        self.lock = threading.Lock()
        self.to_computer = bytearray()
        self.from_computer = bytearray()  # everything, for tests to look at
        self.device = os.open(device, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self.device)
        self.end = None
        self.plug()
        threading.Thread(target=self.run, daemon=True).start()

    def plug(self):
        end, computer = pty.openpty()
        tty.setraw(computer)
        os.set_blocking(end, False)
        if os.path.islink(self.link):
            os.unlink(self.link)
        os.symlink(os.ttyname(computer), self.link)
        with self.lock:
            self.end, self.computer = end, computer

    def pull(self):
        os.unlink(self.link)
        with self.lock:
            os.close(self.computer)
            os.close(self.end)
            self.end = None

    def inject(self, data):
        """As if the device had sent this."""
        with self.lock:
            self.write(self.end, data)

    @staticmethod
    def write(end, data):
        try:
            os.write(end, data)
        except OSError:
            pass  # there is no reader: lost, as on a wire

    @staticmethod
    def read(end):
        try:
            return os.read(end, 4096)
        except OSError:
            return b""

    def run(self):
        while True:
            with self.lock:
                ends = [self.device] + ([self.end] if self.end is not None else [])
            select.select(ends, [], [], 0.005)
            with self.lock:
                said = self.read(self.device)
                if self.end is None:
                    continue
                if said:
                    self.write(self.end, self.damage(said) if self.damage else said)
                answer = self.read(self.end)
                if answer:
                    self.from_computer += answer
                    self.write(self.device, answer)
