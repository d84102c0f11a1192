"""Answers that do not come from magwire: closed forms, quadratures, boundary value problems.

Nothing here may import another part of magwire; import-linter checks it.
"""
