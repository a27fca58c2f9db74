"""All numbers of the slides and of the printed listings, by lecture."""

from lessons.printed.catalogue import PRINTED
from lessons.printed.records import SlideNumber
from lessons.slides import jubair, lmu, pellacini, zwicker

LECTURES = {
    "Zwicker": "Zwicker, Computergrafik, Bern 2016: rendering pipeline",
    "Pellacini": "Pellacini, Computer Graphics: graphics pipeline",
    "Jubair": "Jubair, CSE4203 Computer Graphics: chapter 8, part C, graphics pipeline",
    "LMU": "LMU Munich, Computer Graphics 1, 2020: tutorial 5, rasterization",
}
"""Short name of each lecture to its full one, in the order in which they are listed."""

_OF_SLIDES = (*zwicker.NUMBERS, *pellacini.NUMBERS, *jubair.NUMBERS, *lmu.NUMBERS)
NUMBERS: tuple[SlideNumber, ...] = tuple(
    number
    for lecture in LECTURES
    for number in (*_OF_SLIDES, *(each for printed in PRINTED for each in printed.numbers))
    if number.lecture == lecture
)
"""Every number, lecture by lecture; those of printed listings last."""
