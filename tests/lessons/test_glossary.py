"""The glossary and the guide: enough terms, each found in any text, in plain sentences."""

from lessons.help import find_terms, glossary, guide


def names_in(text):
    return [(text[first:last], term.name) for first, last, term in find_terms(text)]


def test_at_least_150_terms_of_one_to_three_sentences():
    assert len(glossary()) >= 150
    for term in glossary().values():
        assert 1 <= term.text.count(". ") + 1 <= 3, term.name
        assert term.text.endswith(".")
        assert term.text[0].isupper()
        assert "  " not in term.text


def test_every_form_of_a_term_finds_it_and_no_form_is_of_two_terms():
    forms = [(form, term) for term in glossary().values() for form in (term.name, *term.also)]
    assert len({form.lower() for form, _ in forms}) == len(forms)
    for form, term in forms:
        assert names_in(f"It is {form} here.") == [(form, term.name)]


def test_the_longest_form_counts_also_in_the_plural_and_only_whole_words():
    assert names_in("Edge functions of triangles") == [
        ("Edge functions", "edge function"),
        ("triangles", "triangle"),
    ]
    assert names_in("Over: layers over each other") == [("Over", "over operator")]
    assert names_in("knowledge") == []


def test_the_guide_has_a_link_in_every_step():
    assert 8 <= len(guide()) <= 14
    for step in guide():
        assert step.text.endswith(".")
        assert step.links
        assert all(link.startswith("do:") for link in step.links.values())
