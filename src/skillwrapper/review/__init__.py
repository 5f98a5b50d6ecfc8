"""A person looks through a run and corrects it, on a page of this machine."""
