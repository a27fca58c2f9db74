"""Quadratics as words: the same whole numbers wherever they are evaluated and however they are walked."""

import numpy as np

from core.numeric.planes import Quadratic, quadratic_planes


def test_words_are_those_of_the_formula() -> None:
    generator = np.random.default_rng(5)
    column, row = generator.integers(-50, 900, (2, 40))
    fields = [(Quadratic(*generator.uniform(-300, 300, (6, 40)).round(1)), shift) for shift in (0, 21, 42)]
    planes = quadratic_planes(column, row, fields)
    for triangle in range(40):
        x, y = (int(of) for of in generator.integers(0, 1000, 2))
        expected = []
        for k in (0, 1):
            i, j, word = x + k - int(column[triangle]), y - int(row[triangle]), 0
            for field, shift in fields:
                value, across, up, bend, twist, arch = (round(float(of[triangle])) for of in field)
                number = value + across * i + up * j + twist * i * j
                number += bend * i * (i - 1) // 2 + arch * j * (j - 1) // 2
                word += number << shift
            expected.append(word % 2**64)
        word, step = planes.at(*(np.array([of]) for of in (triangle, x, y)))
        assert int(word[0]) % 2**64 == expected[0]
        assert int(step[0]) % 2**64 == (expected[1] - expected[0]) % 2**64
