"""Action models from symbolic traces: given the names of actions and predicates, when each works.

No picture, no invention, no context: whatever an action does, it does to its arguments. So every
transition is looked at from its arguments alone (``views``), which makes learning linear in the
number of transitions and independent of the number of objects (docs/action_models.md).
"""
