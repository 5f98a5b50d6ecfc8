"""Every exception the package raises on purpose, ordered by who must act.

SkillWrapperError
├── UserError                 the user: a file, option or picture must be changed
│   ├── ConfigurationError    a configuration or domain file
│   ├── UnknownNameError      a name that does not exist; says which come close
│   ├── GoalError             a goal expression
│   ├── PictureError          a file that is not a readable picture
│   ├── FileError             a file that is damaged, or cannot be read
│   │   └── FileNotWritableError  ... or cannot be written
│   ├── RunFolderError        a run folder that cannot be used
│   ├── SymbolError           a predicate, atom or operator that is not well formed
│   ├── RefusedModelError     an edited model that recorded data speak against
│   └── MissingDependencyError  something must be installed
├── ProviderError             the provider of a model: key, endpoint, quota, reply
│   ├── AuthenticationError
│   ├── ModelNotFoundError
│   ├── ModelCapabilityError  the model cannot do what is asked (see pictures, ...)
│   ├── ModelUnavailableError no usable answer after all attempts
│   ├── TemporaryProviderError  busy, slow or cut off; another attempt may work
│   │   └── UnusableReplyError  the model refused, or replied nothing
│   └── RecordingError        a recorded run was asked something it never heard
├── LimitReachedError         nobody: a limit the user set was reached; the run can be resumed
├── RobotError                the environment: a robot or simulator did not do its part
│   ├── EmergencyStopError    ... because somebody stopped it
│   └── ConformanceError      its author: it breaks a rule that every environment must keep
└── InternalError             us: please report it
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence

from skillwrapper.usage import Usage


class SkillWrapperError(Exception):
    """Root of all exceptions raised on purpose."""

    exit_code: int = 1


class UserError(SkillWrapperError):
    """The user can mend this; the message says how."""

    exit_code = 2


class ConfigurationError(UserError):
    """A configuration or domain file is not what it should be."""


class UnknownNameError(UserError):
    """A name that does not exist.

    Args:
        kind: what the name should have named, e.g. ``"predicate"``.
        name: the name that was given.
        known: the names that exist.
        where: optional place, e.g. a file and line.
    """

    def __init__(self, kind: str, name: str, known: Iterable[str], where: str = "") -> None:
        options = sorted(known)
        near = difflib.get_close_matches(name, options, n=1, cutoff=0.5)
        hint = f"did you mean '{near[0]}'?" if near else f"known: {', '.join(options) or 'none'}"
        place = f"{where}: " if where else ""
        super().__init__(f"{place}unknown {kind} '{name}'; {hint}")
        self.kind, self.name = kind, name


class GoalError(UserError):
    """A goal expression cannot be understood."""


class PictureError(UserError):
    """A file is not a picture, or not one of the expected size."""


class FileError(UserError):
    """A file is damaged, or cannot be read or written."""


class FileNotWritableError(FileError):
    """A file cannot be written: its folder, its rights or its medium do not allow it."""


class RunFolderError(UserError):
    """A run folder is missing, holds something else or was made with other settings."""


class SymbolError(UserError):
    """A predicate, atom or operator is not well formed."""


class MissingDependencyError(UserError):
    """Something is not installed.

    Args:
        what: the missing thing.
        how: the command that installs it.
    """

    def __init__(self, what: str, how: str) -> None:
        super().__init__(f"{what} is not installed; install it with: {how}")


class RefusedModelError(UserError):
    """An edited model that what is recorded speaks against.

    Args:
        path: of the model.
        reasons: all of them, each with its place.
    """

    def __init__(self, path: object, reasons: Sequence[str]) -> None:
        more = f" (and {len(reasons) - 1} more reasons)" if len(reasons) > 1 else ""
        super().__init__(f"{path}: refused, the run is as it was: {reasons[0]}{more}")
        self.reasons = tuple(reasons)


class ProviderError(SkillWrapperError):
    """A model provider did not do its part; the message says what to do."""

    exit_code = 2


class AuthenticationError(ProviderError):
    """The provider refused the key."""


class ModelNotFoundError(ProviderError):
    """The provider does not know the model, or the address is not an endpoint."""


class ModelCapabilityError(ProviderError):
    """The model cannot do what is asked, e.g. it accepts no pictures."""


class ModelUnavailableError(ProviderError):
    """No usable answer came after all attempts."""


class TemporaryProviderError(ProviderError):
    """An attempt failed in a way that another attempt may not.

    Args:
        message: what happened.
        retry_after: how many seconds the provider asks to wait; None if it does not say.
    """

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        super().__init__(message)
        self.retry_after = retry_after


class UnusableReplyError(TemporaryProviderError):
    """The model refused, or replied nothing.

    Args:
        message: what happened.
        kind: ``"refused"`` or ``"empty"``.
        text: what it said, may be empty.
        usage: what the call took, if the provider says.
    """

    def __init__(self, message: str, kind: str, text: str = "", usage: Usage | None = None) -> None:
        super().__init__(message)
        self.kind, self.text, self.usage = kind, text, usage


class ReplyCutOffError(ProviderError):
    """Replies to one question ended at the output limit twice; the message says which to raise."""


class RecordingError(ProviderError):
    """A recorded run was asked something that was never asked when it was recorded."""


class LimitReachedError(SkillWrapperError):
    """A limit set by the user was reached; the run can be resumed."""

    exit_code = 3


class RobotError(SkillWrapperError):
    """A robot or simulator did not do its part."""


class EmergencyStopError(RobotError):
    """The emergency stop of a robot says that nothing may move."""


class ConformanceError(RobotError):
    """An environment breaks a rule that every environment must keep.

    Args:
        check: name of the check that failed.
        message: what was expected, and what came.
    """

    def __init__(self, check: str, message: str) -> None:
        super().__init__(f"{check}: {message}")
        self.check = check


class InternalError(SkillWrapperError):
    """A mistake of ours; the message says what to report."""
