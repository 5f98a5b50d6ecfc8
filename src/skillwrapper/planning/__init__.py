"""Planning: from a picture and a goal to skill plans."""
