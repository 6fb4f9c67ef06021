"""An open referee: exact problems on which any simulator of stick-slip can be tried."""

from .problems import CLASSES, Answers, Asked, NotExpressibleError, Problem, problems, read

__all__ = ["CLASSES", "Answers", "Asked", "NotExpressibleError", "Problem", "problems", "read"]
