"""Calls of nodes that wait for nothing but the answer, so that many can be under way at the same time.

Such a call is a generator. It yields None when its arguments are checked and before anything is sent; then the
connection on which the answer comes, when the request is on its way; it returns what the answer says. One that is closed
before its end has been interrupted.
"""
import functools
import os
import select
from concurrent.futures import ThreadPoolExecutor

from .errors import MpmError


def completed(call):
    """What `call` returns, after waiting for it."""
    try:
        while True:
            next(call)
    except StopIteration as done:
        return done.value


def whole(begin):
    """A method that waits, of a generator `begin`, which stays its attribute `begin`."""
    @functools.wraps(begin)
    def wait(*arguments, **named):
        return completed(begin(*arguments, **named))
    wait.begin = begin
    return wait


def side_by_side(calls):
    """Runs `calls`, a dict: key to generator, at the same time. Returns what they return, and the MpmError of those that
    fail, each by key. A fault in the arguments of any is raised before anything is sent."""
    try:
        for key, call in calls.items():
            try:
                next(call)
            except MpmError as error:
                raise MpmError(f"simulator {key}: {error}", error.exit_code) from error
        return _answers(calls)
    finally:
        for call in calls.values():
            call.close()


def _answers(calls):
    found, failures, waiting = {}, {}, {}
    poll = select.poll()  # select() takes no file descriptor above 1023

    def advance(key):
        try:
            connection = next(calls[key])
        except StopIteration as done:
            found[key] = done.value
        except MpmError as error:
            failures[key] = error
        else:
            waiting[connection.fileno()] = key
            poll.register(connection, select.POLLIN)

    for key in calls:
        advance(key)
    while waiting:
        for place, _ in poll.poll():
            poll.unregister(place)
            advance(waiting.pop(place))
    return found, failures


def in_threads(work, keys):
    """Does `work(key)`, which waits for processes, for several keys at the same time. Returns the MpmError of those that
    fail, by key. When it is interrupted, what has begun is completed."""
    failures = {}

    def one(key):
        try:
            work(key)
        except MpmError as error:
            failures[key] = error

    with ThreadPoolExecutor(max_workers=2 * (os.cpu_count() or 1)) as pool:
        futures = [pool.submit(one, key) for key in keys]
        try:
            for future in futures:
                future.result()
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return dict(sorted(failures.items()))
