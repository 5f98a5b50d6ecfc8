"""Files: YAML documents with the line of every mistake, and writing that a crash cannot spoil."""
