"""A file for each command, by its name; what they share is one floor up."""
