"""Listings read to nodes: what Python reads to a tree is looked at node by node, and never executed."""

import ast
from collections.abc import Sequence

from core.lanes import nodes
from core.lanes.problem import LARGEST, Place, Problem
from core.lanes.python_values import TOO_LARGE

DEEPEST = 160
"""Operations, conditions and blocks that may stand in each other."""
OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.Pow: "**",
    ast.LShift: "<<",
    ast.RShift: ">>",
    ast.BitAnd: "&",
    ast.BitOr: "|",
    ast.BitXor: "^",
}
COMPARISONS: dict[type[ast.cmpop], str] = {
    ast.Lt: "<",
    ast.Gt: ">",
    ast.LtE: "<=",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
PREFIXES: dict[type[ast.unaryop], str] = {ast.USub: "-", ast.UAdd: "+", ast.Not: "not"}
OUTSIDE: dict[type[ast.AST], str] = {
    ast.Import: "import",
    ast.ImportFrom: "import",
    ast.With: "with",
    ast.Try: "try",
    ast.Lambda: "lambda",
    ast.ClassDef: "class",
    ast.Global: "global",
    ast.Nonlocal: "nonlocal",
    ast.Raise: "this way to raise",
    ast.Delete: "this way to delete",
    ast.Assert: "assert",
    ast.JoinedStr: "an f-string",
    ast.NamedExpr: ":=",
    ast.Dict: "a dictionary",
    ast.Set: "a set",
    ast.Await: "await",
    ast.Yield: "yield",
    ast.YieldFrom: "yield",
    ast.AsyncFunctionDef: "async",
    ast.AsyncFor: "async",
    ast.AsyncWith: "async",
    ast.Match: "match",
    ast.FunctionDef: "a function inside of a function",
    ast.MatMult: "@",
    ast.BitOr: "|",
    ast.Invert: "~",
    ast.Slice: "a slice whose ends are not written out",
    ast.DictComp: "a dictionary",
    ast.SetComp: "a set",
}
"""What has a name of its own in a sentence."""


class Reader:
    """Reads functions of one text; ``lines`` are the lines of it."""

    def __init__(self, lines: Sequence[str]) -> None:
        self._lines, self._depth = lines, 0

    def place(self, node: ast.AST) -> Place:
        """Return where a node begins; ``ast`` counts bytes."""
        line, offset = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
        text = self._lines[line - 1] if line <= len(self._lines) else ""
        before = text.encode("utf-8", "surrogatepass")[:offset].decode("utf-8", "replace")
        return Place(line, len(before) + 1)

    def function(self, node: ast.FunctionDef) -> nodes.Function:
        """Read one function."""
        given = node.args
        if given.kwonlyargs or given.vararg or given.kwarg or given.posonlyargs or node.decorator_list:
            raise Problem(self.place(node), "a function has plain parameters only")
        parameters = tuple(argument.arg for argument in given.args)
        body = self._body(node.body)
        if _returns_somewhere(body) and not _always_returns(body):
            raise Problem(
                body[-1].place, f"{node.name} may end here without return: its last line must be return ..."
            )
        return nodes.Function(self.place(node), node.name, parameters, body)

    def _refuse(self, node: ast.AST) -> Problem:
        word = OUTSIDE.get(type(node))
        if word is None and isinstance(node, ast.Attribute):
            word = f".{node.attr}"
        if word is None and isinstance(node, ast.Call):
            return Problem(self.place(node), "a function is called by its name, with plain values")
        if word is None and isinstance(node, ast.For | ast.While):
            return Problem(self.place(node), "a loop has no else in the language of listings")
        return Problem(self.place(node), f"{word or 'this'} is not in the language of listings")

    def _deeper(self, node: ast.AST) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            raise Problem(self.place(node), "too much stands in each other here")

    def _body(self, body: Sequence[ast.stmt]) -> tuple[nodes.Statement, ...]:
        self._deeper(body[0])
        found = tuple(self._statement(node) for node in body)
        self._depth -= 1
        return found

    def _statement(self, node: ast.stmt) -> nodes.Statement:
        place = self.place(node)
        match node:
            case ast.Expr(ast.Constant(str())) | ast.Pass() | ast.Delete([ast.Name()]):
                return nodes.Nothing(place)
            case ast.Raise(exc=ast.Call(args=args)):
                text = args[0].value if args and isinstance(args[0], ast.Constant) else None
                said = text if isinstance(text, str) else "the listing stops here"
                return nodes.Evaluate(place, nodes.Call(place, "raise", (nodes.Constant(place, said),)))
            case ast.Assign(targets, value):
                return self._assign(place, targets, value)
            case ast.AnnAssign(target=ast.Name() as target, value=ast.expr() as value):
                return nodes.Assign(place, self._left(target), self._value(value))
            case ast.AugAssign(target, operator, value) if type(operator) in OPERATORS:
                changed = nodes.Binary(
                    place, OPERATORS[type(operator)], self._value(target), self._value(value)
                )
                return nodes.Assign(place, self._left(target), changed)
            case ast.If(test, yes, no):
                return nodes.If(place, self._value(test), self._body(yes), self._body(no) if no else ())
            case ast.While(test, body, []):
                return nodes.Loop(place, self._value(test), self._body(body))
            case ast.For(target, things, body, []):
                return nodes.Each(place, self._left(target), self._value(things), self._body(body))
            case ast.Return(value):
                return nodes.Return(place, None if value is None else self._value(value))
            case ast.Break():
                return nodes.Break(place)
            case ast.Continue():
                return nodes.Continue(place)
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(name), "append"), [value], [])):
                return nodes.Put(place, name, self._value(value))
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(), "append"))):
                raise Problem(
                    place, ".append takes one value: put brackets around several, as .append((x, y))"
                )
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(), attribute))):
                raise Problem(
                    place, f".{attribute} is not in the language of listings: a list has .append(value)"
                )
            case ast.Expr(ast.Compare(ops=[ast.Eq()])):
                raise Problem(place, "this line changes nothing: == compares, to store a value write =")
            case ast.Expr(ast.Compare() | ast.BinOp() | ast.Name() | ast.Constant() | ast.Subscript()):
                raise Problem(place, "this line changes nothing: a value is stored by name = ...")
            case ast.Expr(value):
                return nodes.Evaluate(place, self._value(value))
        raise self._refuse(node)

    def _assign(self, place: Place, targets: Sequence[ast.expr], value: ast.expr) -> nodes.Statement:
        *others, last = targets
        first = nodes.Assign(place, self._left(last), self._value(value))
        if not others:
            return first
        again = [nodes.Assign(place, self._left(target), self._value(last)) for target in others]
        return nodes.Block(place, (first, *again))

    def _left(self, node: ast.expr) -> nodes.Expression:
        place = self.place(node)
        match node:
            case ast.Starred(value):
                return nodes.Star(place, self._left(value))
            case ast.Tuple(parts) | ast.List(parts):
                return nodes.Many(place, tuple(self._left(part) for part in parts))
            case ast.Name() | ast.Subscript():
                return self._value(node)
            case ast.Attribute():
                raise self._refuse(node)
        raise Problem(place, "the left side of = must be a name, or several")

    def _values(self, values: Sequence[ast.expr]) -> tuple[nodes.Expression, ...]:
        return tuple(self._value(value) for value in values)

    def _value(self, node: ast.expr) -> nodes.Expression:
        self._deeper(node)
        found = self._simple(node) or self._compound(node)
        self._depth -= 1
        if found is None:
            raise self._refuse(node)
        return found

    def _simple(self, node: ast.expr) -> nodes.Expression | None:
        place = self.place(node)
        match node:
            case ast.Constant(bool() | int() | float() | str() | None as value):
                if isinstance(value, int) and abs(value) > LARGEST:
                    raise Problem(place, TOO_LARGE)
                return nodes.Constant(place, value)
            case ast.Name(name):
                return nodes.Name(place, name)
            case ast.BinOp(left, operator, right):
                if type(operator) not in OPERATORS:
                    raise self._refuse(operator if type(operator) in OUTSIDE else node)
                return nodes.Binary(place, OPERATORS[type(operator)], self._value(left), self._value(right))
            case ast.UnaryOp(operator, operand):
                if type(operator) not in PREFIXES:
                    raise Problem(place, "~ is not in the language of listings: write not")
                return nodes.Unary(place, PREFIXES[type(operator)], self._value(operand))
            case ast.BoolOp(operator, parts):
                return nodes.Logic(place, isinstance(operator, ast.And), self._values(parts))
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp(test, yes, no):
                return nodes.Choose(place, self._value(test), self._value(yes), self._value(no))
        return None

    def _compound(self, node: ast.expr) -> nodes.Expression | None:
        place = self.place(node)
        match node:
            case ast.Tuple(parts) | ast.List(parts):
                made = [
                    nodes.Star(place, self._value(part.value))
                    if isinstance(part, ast.Starred)
                    else self._value(part)
                    for part in parts
                ]
                return nodes.Many(place, tuple(made))
            case ast.Subscript(whole, ast.Slice() as ends):
                return self._slice(place, whole, ends)
            case ast.Subscript(whole, index):
                return nodes.Index(place, self._value(whole), self._value(index))
            case ast.ListComp(element, [of]) | ast.GeneratorExp(element, [of]):
                tests = self._values(of.ifs)
                return nodes.Gather(
                    place, self._value(element), self._left(of.target), self._value(of.iter), tests
                )
            case ast.Call():
                return self._call(place, node)
        return None

    def _comparison(self, node: ast.Compare) -> nodes.Expression:
        place = self.place(node)
        match node:
            case ast.Compare(left, [ast.Is() | ast.IsNot() as operator], [ast.Constant(None)]):
                found: nodes.Expression = nodes.Call(place, "is None", (self._value(left),))
                return found if isinstance(operator, ast.Is) else nodes.Unary(place, "not", found)
            case ast.Compare(left, [ast.In() | ast.NotIn() as operator], [right]):
                found = nodes.Call(place, "in", (self._value(left), self._value(right)))
                return found if isinstance(operator, ast.In) else nodes.Unary(place, "not", found)
        if not all(type(operator) in COMPARISONS for operator in node.ops):
            raise Problem(place, "is and in do not stand in a row of comparisons: numbers are compared by ==")
        sides = self._values((node.left, *node.comparators))
        pairs = [
            nodes.Binary(place, COMPARISONS[type(operator)], left, right)
            for left, operator, right in zip(sides, node.ops, sides[1:], strict=False)
        ]
        return pairs[0] if len(pairs) == 1 else nodes.Logic(place, True, tuple(pairs))

    def _slice(self, place: Place, whole: ast.expr, ends: ast.Slice) -> nodes.Expression:
        if ends.step is not None and ends.lower is None and ends.upper is None:
            return nodes.Call(place, "range by", (self._value(whole), self._value(ends.step)))
        written = [None if end is None else _whole_number(end) for end in (ends.lower, ends.upper)]
        if ends.step is not None or "other" in written:
            raise self._refuse(ends)
        first, end = (nodes.Constant(place, number) for number in written)
        return nodes.Call(place, "slice of", (self._value(whole), first, end))

    def _call(self, place: Place, node: ast.Call) -> nodes.Expression:
        match node:
            case ast.Call(ast.Name("zip" | "pairwise" as name), arguments, keywords):
                if any(keyword.arg != "strict" for keyword in keywords):
                    raise self._refuse(node)
                return nodes.Call(place, name, self._values(arguments))
            case ast.Call(ast.Name(name), arguments, []):
                return nodes.Call(place, name, self._values(arguments))
            case ast.Call(ast.Attribute(ast.Name("np"), "float32" | "rint" as name), arguments, []):
                return nodes.Call(place, name, self._values(arguments))
            case ast.Call(ast.Attribute(attr=name)):
                raise Problem(place, f".{name} is not in the language of listings")
        raise self._refuse(node)


def _whole_number(node: ast.expr) -> int | str:
    """Return a number that is written out, with or without a sign, else ``other``."""
    match node:
        case ast.Constant(int() as number):
            return number
        case ast.UnaryOp(ast.USub(), ast.Constant(int() as number)):
            return -number
    return "other"


def _returns_somewhere(body: Sequence[nodes.Statement]) -> bool:
    """Return whether a return with a value stands in some statements."""
    for statement in body:
        match statement:
            case nodes.Return(_, nodes.Expression()):
                return True
            case nodes.If(_, _, yes, no) if _returns_somewhere((*yes, *no)):
                return True
            case nodes.Loop(_, _, inner) | nodes.Each(_, _, _, inner) if _returns_somewhere(inner):
                return True
    return False


def _always_returns(body: Sequence[nodes.Statement]) -> bool:
    """Return whether some statements leave the function on every way through them."""
    match body[-1]:
        case nodes.Return() | nodes.Evaluate(_, nodes.Call(_, "raise")):
            return True
        case nodes.If(_, _, yes, no):
            return bool(no) and _always_returns(yes) and _always_returns(no)
        case nodes.Loop(_, nodes.Constant(_, True)):
            return True
    return False
