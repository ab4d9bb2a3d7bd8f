"""One context's calls: one at a time, interruptible, and none across fork."""
import _thread
import collections
import contextlib
import ctypes
import logging
import os
import queue
import threading
from typing import Any, Callable, Deque, Iterator, List, Optional, Tuple

from . import _abi, _library
from .errors import ArgumentError, UnsupportedError

Progress = Callable[[float], Any]

_logger = logging.getLogger("brume")
_LEVELS = {_abi.LOG_ERROR: logging.ERROR, _abi.LOG_WARNING: logging.WARNING, _abi.LOG_INFO: logging.INFO,
           _abi.LOG_DEBUG: logging.DEBUG}
_contexts_made = False
_forked = False


def _in_child() -> None:
    global _forked
    _forked = _contexts_made


os.register_at_fork(after_in_child=_in_child)


# Failures are exceptions already, so logging tells them only to those who ask for details.
@_abi.LogCallback
def _log(_user: int, level: int, message: bytes) -> None:
    level = logging.DEBUG if level == _abi.LOG_ERROR else _LEVELS.get(level, logging.INFO)
    _logger.log(level, "%s", message.decode("utf-8", "replace"))


class _Call:
    """A call that asks for progress."""

    def __init__(self, listener: Optional[Progress]) -> None:
        self.listener = listener
        self.cancelled = False
        self.error: Optional[BaseException] = None

    def asked(self, fraction: float) -> bool:
        try:
            if self.listener and not self.cancelled and self.listener(fraction):
                self.cancelled = True
        except BaseException as error:  # ctypes would print it and go on
            self.stop(error)
        return self.cancelled

    def stop(self, error: BaseException) -> None:
        self.error = self.error or error
        self.cancelled = True


class _Progress:
    """What a context asks while a call runs. Not the session itself, which would then be kept by its own callback."""

    call: Optional[_Call] = None

    def asked(self, _user: int, fraction: float) -> int:
        return self.call.asked(fraction) if self.call else 0


class Session:
    """A brume_context with its lock. Scenes and plans hold on to it."""

    def __init__(self, desc: _abi.brume_context_desc) -> None:
        global _contexts_made
        _refuse_fork()
        _contexts_made = True
        self.handle: Optional[ctypes.c_void_p] = None
        self._lock = threading.Lock()
        self._owner = 0
        self._dead: Deque[Tuple[Callable[[Any], None], Any]] = collections.deque()
        self._progress = _Progress()
        # Kept here, as long as the context may call it.
        self._callback = _abi.ProgressCallback(self._progress.asked)
        desc.progress = self._callback
        desc.log = _log
        handle = ctypes.c_void_p()
        _library.check(None, _library.library().brume_context_create(ctypes.byref(desc), ctypes.byref(handle)))
        self.handle = handle

    @contextlib.contextmanager
    def entered(self, owner: Optional[int] = None) -> Iterator[ctypes.c_void_p]:
        """The handle, for this thread alone. owner: the thread that it works for."""
        _refuse_fork()
        owner = owner or threading.get_ident()
        if self._owner == owner:
            raise ArgumentError("context: used from its own progress function; expected no call while one runs")
        with self._lock:
            self._owner = owner
            try:
                if self.handle is None:
                    raise ArgumentError("context: closed; expected an open one")
                yield self.handle
            finally:
                self._owner = 0
        self._bury()

    def call(self, function: Any, *arguments: Any) -> None:
        """A function of the ABI that answers with a status."""
        with self.entered() as handle:
            _library.check(handle, function(*arguments))

    def long_call(self, progress: Optional[Progress], function: Any, *arguments: Any, keep: Any = None) -> None:
        """The same for one that asks for progress. It ends early by an exception of `progress`, and by Ctrl-C.

        keep: what the arguments point to.
        """
        call, caller = _Call(progress), threading.get_ident()

        def work(_keep: Any = keep) -> None:
            with self.entered(caller) as handle:
                self._progress.call = call
                try:
                    _library.check(handle, function(*arguments))
                finally:
                    self._progress.call = None

        if threading.current_thread() is threading.main_thread():
            failure = _beside(work, call)
        else:
            failure = _failure_of(work)
        if call.error or failure:
            raise call.error or failure  # type: ignore[misc]

    def release(self, destroy: Callable[[Any], None], handle: Any) -> None:
        """Destroys an object, now or when the call that runs has ended: this may be the garbage collector in the midst of it."""
        self._dead.append((destroy, handle))
        self._bury()

    def close(self) -> None:
        handle, self.handle = self.handle, None
        if handle is not None:
            self.release(_library.library().brume_context_destroy, handle)

    def _bury(self) -> None:
        while self._dead and not _forked and self._lock.acquire(blocking=False):
            try:
                while self._dead:
                    destroy, handle = self._dead.popleft()
                    destroy(handle)
            finally:
                self._lock.release()


def _beside(work: Callable[[], None], call: _Call) -> Optional[BaseException]:
    """Does the work on another thread. Python handles signals on the main one, and while a call of C runs there it does not.

    A signal may come between any two steps here. So the other thread has the lock and all that it needs: where an exception
    gets out in spite of the loop, the work ends by itself.
    """
    questions: "queue.SimpleQueue[Optional[float]]" = queue.SimpleQueue()
    answers: "queue.SimpleQueue[bool]" = queue.SimpleQueue()
    done: List[Optional[BaseException]] = []
    progress = call.listener

    def ask(fraction: float) -> bool:
        questions.put(fraction)
        return answers.get()

    def run() -> None:
        done.append(_failure_of(work))
        questions.put(None)

    if progress:
        call.listener = ask
    try:
        # Not a Thread, whose start() waits for it.
        _thread.start_new_thread(run, ())
        while True:
            try:
                while not (done and questions.empty()):
                    fraction = questions.get()
                    if fraction is not None and progress:
                        answers.put(bool(progress(fraction)))
                break
            except BaseException as error:
                call.stop(error)
                answers.put(True)
    finally:
        call.cancelled = True
        answers.put(True)
    return done[0]


def _failure_of(work: Callable[[], None]) -> Optional[BaseException]:
    try:
        work()
    except BaseException as error:
        return error
    return None


def _refuse_fork() -> None:
    if _forked:
        raise UnsupportedError("context: this process was forked from one that had a context, whose threads it lacks; make the "
                               "first one here, or start processes by multiprocessing's 'spawn'")
