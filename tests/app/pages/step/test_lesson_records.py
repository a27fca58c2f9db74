"""What the pane of a lesson says of a lesson's file."""

from app.pages.lessons.states import answered


def test_each_question_is_told_with_the_course_that_asks_it() -> None:
    text = "LMU, Task 2 g): what if the face is 0? Jubair: what is the disadvantage?"
    assert answered(text) == (
        "What if the face is 0? (from the course at the LMU, Task 2 g)\n"
        "What is the disadvantage? (from Jubair’s course)"
    )
    assert answered("why a floor swims") == "why a floor swims"
