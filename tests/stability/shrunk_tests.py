"""Run the test that the shrinker writes."""


def run_test(text: str) -> None:
    """Run the one test in the text of a file."""
    names: dict[str, object] = {}
    exec(compile(text, "a shrunk test", "exec"), names)
    (test,) = [value for name, value in names.items() if name.startswith("test_")]
    test()
