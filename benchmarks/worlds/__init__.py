"""Small made-up worlds, a reader that knows what is true in their pictures, and what is learned.

Nothing of the package was written for them. They have what robots' worlds have and the bundled
kitchen lacks: dead ends, successes that change nothing, changes that depend, several scenes,
furniture as objects, pictures that never repeat, skills that rarely work, last skills of a chain.
"""
