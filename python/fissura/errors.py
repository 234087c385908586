"""What can go wrong, as exceptions."""


class InputError(ValueError):
    """A faulty case. `findings` holds (file, line, column, message) of each fault."""

    def __init__(self, message, findings=()):
        super().__init__(message)
        self.findings = list(findings)


class RunError(RuntimeError):
    """A run that failed on the way: its energy balance was lost, a number was no longer finite."""


class FileError(OSError):
    """Something that cannot be read or written."""
