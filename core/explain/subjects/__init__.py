"""One module for each subject: its rows (sentence, formula, question) and its variables."""
