"""Problems, and what comes of trying to solve them."""
