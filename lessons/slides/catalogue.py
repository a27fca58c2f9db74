"""All numbers of the slides and of the printed listings, by lecture."""

from lessons.printed.catalogue import PRINTED
from lessons.printed.records import SlideNumber
from lessons.slides import jubair, lmu, pellacini, zwicker
from lessons.slides.scenes import LECTURES

_OF_SLIDES = (*zwicker.NUMBERS, *pellacini.NUMBERS, *jubair.NUMBERS, *lmu.NUMBERS)
NUMBERS: tuple[SlideNumber, ...] = tuple(
    number
    for lecture in LECTURES
    for number in (*_OF_SLIDES, *(each for printed in PRINTED for each in printed.numbers))
    if number.lecture == lecture
)
"""Every number, lecture by lecture; those of printed listings last."""
