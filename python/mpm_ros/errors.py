"""The one exception of this package."""


class MpmError(RuntimeError):
    """What failed, where, and what to do, in one sentence; for failures of the node it is the node's own sentence.

    `exit_code`: of the node, where it has ended (2 bad input, 3 the physics failed, 1 the machine, 128 + n killed
    by signal n); else None.
    """

    def __init__(self, sentence, exit_code=None):
        super().__init__(sentence)
        self.exit_code = exit_code
