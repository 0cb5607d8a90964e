"""Text → tree of the formula language, written from FORMAT.md ("Formulas") alone.

A tree is made of tuples: ("number", float), ("name", str), ("not", a), ("-", a), (operator, a, b) and
("call", name, [arguments]). What `let` names is one tuple, used wherever the name stands.
"""

import re

TOKEN = re.compile(
    r"(?P<number>(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*)|(?P<sign>[<>=!]=|[-+*/^<>=(),;·−])"
)
BLANK = re.compile(r"(\s|#[^\n]*)*")
LEVELS = [
    ["or"],
    ["and"],
    ["not"],
    ["<", "<=", ">", ">=", "==", "!="],
    ["+", "-"],
    ["*", "/"],
    [],
    ["^"],
]
NOT, COMPARISON, POWER = 2, 3, 7
STRENGTH = {operator: level for level, row in enumerate(LEVELS) for operator in row}


def tokens(text):
    position, found = BLANK.match(text).end(), []
    while position < len(text):
        match = TOKEN.match(text, position)
        if not match:
            raise SyntaxError(f"no formula at {position}: {text!r}")
        found.append((match.lastgroup if match["number"] is None else "number", match[0]))
        position = BLANK.match(text, match.end()).end()
    return found + [("end", "")]


class Parser:
    def __init__(self, text):
        self.tokens, self.next, self.lets = tokens(text), 0, []

    def peek(self):
        return {"·": "*", "−": "-"}.get(self.tokens[self.next][1], self.tokens[self.next][1])

    def take(self, expected=None):
        kind, text = self.tokens[self.next][0], self.peek()
        if expected is not None and text != expected:
            raise SyntaxError(f"{text!r} instead of {expected!r}")
        self.next += 1
        return kind, text

    def block(self):
        outer = len(self.lets)
        while self.peek() == "let":
            self.take()
            name = self.take()[1]
            self.take("=")
            value = self.expression(0)
            self.take(";")
            self.lets.append((name, value))
        value = self.expression(0)
        del self.lets[outer:]
        return value

    def expression(self, weakest):
        left = self.operand()
        while STRENGTH.get(self.peek(), -1) >= weakest and self.peek() != "not":
            operator = self.take()[1]
            strength = STRENGTH[operator]
            right = self.expression(strength + (operator != "^"))
            left = (operator, left, right)
        return left

    def operand(self):
        kind, text = self.take()
        if text == "-":
            return ("-", self.expression(POWER))
        if text == "+":
            return self.expression(POWER)
        if text == "not":
            return ("not", self.expression(COMPARISON))
        if text == "(":
            inner = self.block()
            self.take(")")
            return inner
        if kind == "number":
            return ("number", float(text))
        if kind != "name":
            raise SyntaxError(f"unexpected {text!r}")
        return self.call(text) if self.peek() == "(" else self.name(text)

    def name(self, name):
        bound = [value for known, value in self.lets if known == name]
        return bound[-1] if bound else ("name", name)

    def call(self, name):
        self.take("(")
        arguments = [self.block()]
        while self.peek() == ",":
            self.take()
            arguments.append(self.block())
        self.take(")")
        return ("call", name, arguments)


def parse(text):
    """The tree of a formula."""
    parser = Parser(text)
    tree = parser.block()
    parser.take("")
    return tree
