"""Small planning domains, one for each way in which real ones are awkward, and walks in them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from skillwrapper.action_models.steps import State, Step
from skillwrapper.action_models.strips import Strips, read_strips

FERRY = """
(define (domain boats) (:requirements :typing :equality :negative-preconditions)
(:types boat car - movable movable harbour - object)
(:constants home - harbour)
(:predicates (at ?m - movable ?h - harbour) (aboard ?c - car ?b - boat) (full ?b - boat) (storm))
(:action sail :parameters (?b - boat ?from ?to - harbour)
  :precondition (and (at ?b ?from) (not (storm))) :effect (and (not (at ?b ?from)) (at ?b ?to)))
(:action return :parameters (?b - boat ?from - harbour)
  :precondition (at ?b ?from) :effect (and (not (at ?b ?from)) (at ?b home)))
(:action board :parameters (?c - car ?b - boat ?h - harbour)
  :precondition (and (at ?c ?h) (at ?b ?h) (not (full ?b)))
  :effect (and (aboard ?c ?b) (full ?b) (not (at ?c ?h))))
(:action land :parameters (?c - car ?b - boat ?h - harbour)
  :precondition (and (aboard ?c ?b) (at ?b ?h))
  :effect (and (at ?c ?h) (not (aboard ?c ?b)) (not (full ?b))))
(:action wait :parameters () :precondition (storm) :effect (not (storm)))
(:action brew :parameters () :precondition (not (storm)) :effect (storm)))
"""
"""Constants, a deep type hierarchy, equal arguments, no arguments, negative preconditions."""

LAMPS = """
(define (domain lamps)
(:requirements :typing :conditional-effects :equality :negative-preconditions)
(:types switch lamp)
(:predicates (wired ?s - switch ?l - lamp) (lit ?l - lamp) (up ?s - switch) (next ?a ?b - switch))
(:action flip :parameters (?s - switch ?l - lamp)
  :precondition (up ?s)
  :effect (and (not (up ?s)) (when (wired ?s ?l) (lit ?l))))
(:action lift :parameters (?s - switch ?l - lamp)
  :precondition (not (up ?s)) :effect (and (up ?s) (not (lit ?l))))
(:action swap :parameters (?a ?b - switch)
  :precondition (and (up ?a) (not (up ?b)) (not (= ?a ?b)))
  :effect (and (up ?b) (not (up ?a)))))
"""
"""Conditional effects, and arguments that must differ."""

MINE = """
(define (domain mine) (:requirements :typing)
(:types cell)
(:predicates (loose ?x - cell) (gold ?x - cell) (clear ?x - cell))
(:action blast :parameters (?x - cell)
  :precondition (loose ?x) :effect (and (clear ?x) (not (loose ?x)) (not (gold ?x))))
(:action stay :parameters () :precondition () :effect ()))
"""
"""An action that ends what few objects have and nothing else changes."""

LOCKS = """
(define (domain locks) (:requirements :typing :negative-preconditions)
(:types chamber barge level)
(:constants low high - level)
(:predicates (water ?c - chamber ?l - level) (gate ?c - chamber ?l - level)
  (inside ?b - barge ?c - chamber) (waiting ?b - barge ?l - level) (busy))
(:action pump :parameters (?c - chamber ?from ?to - level)
  :precondition (and (water ?c ?from) (not (gate ?c low)) (not (gate ?c high)))
  :effect (and (not (water ?c ?from)) (water ?c ?to) (busy)))
(:action rest :parameters () :precondition (busy) :effect (not (busy)))
(:action swing :parameters (?c - chamber ?l - level)
  :precondition (and (water ?c ?l) (not (gate ?c ?l)) (not (busy))) :effect (gate ?c ?l))
(:action shut :parameters (?c - chamber ?l - level)
  :precondition (gate ?c ?l) :effect (not (gate ?c ?l)))
(:action enter :parameters (?b - barge ?c - chamber ?l - level)
  :precondition (and (waiting ?b ?l) (gate ?c ?l))
  :effect (and (not (waiting ?b ?l)) (inside ?b ?c)))
(:action leave :parameters (?b - barge ?c - chamber ?l - level)
  :precondition (and (inside ?b ?c) (gate ?c ?l))
  :effect (and (waiting ?b ?l) (not (inside ?b ?c)))))
"""
"""Negative preconditions about constants, and levels that may be named twice."""

POST = """
(define (domain post) (:requirements :typing :adl)
(:types van bike letter - object)
(:predicates (at ?x - (either van bike) ?o - letter) (paid ?o - letter) (valid ?o - letter)
  (linked ?a ?b - van) (free ?a - van) (rain))
(:action pair :parameters (?a ?b - van) :precondition (and (free ?a) (free ?b) (not (= ?a ?b)))
  :effect (and (linked ?a ?b) (linked ?b ?a) (not (free ?a)) (not (free ?b))))
(:action part :parameters (?a ?b - van) :precondition (linked ?a ?b)
  :effect (and (not (linked ?a ?b)) (not (linked ?b ?a)) (free ?a) (free ?b)))
(:action stamp :parameters (?o - letter) :precondition (not (valid ?o))
  :effect (and (when (paid ?o) (valid ?o)) (not (rain)) (when (rain) (not (paid ?o)))))
(:action pay :parameters (?o - letter) :precondition (not (paid ?o)) :effect (paid ?o))
(:action void :parameters (?o - letter)
  :precondition (valid ?o) :effect (and (not (valid ?o)) (rain)))
(:action hand :parameters (?o - letter ?x ?y - (either van bike))
  :precondition (at ?x ?o) :effect (and (not (at ?x ?o)) (at ?y ?o))))
"""
"""Types of which one is enough, symmetric relations, and two conditional effects of one action."""

BELLS = """
(define (domain bells) (:requirements :typing :adl)
(:types bell)
(:predicates (wired ?b - bell) (powered ?b - bell) (wound ?b - bell) (rings ?b - bell))
(:action pull :parameters (?b - bell) :precondition (not (rings ?b))
  :effect (and (when (and (wired ?b) (powered ?b)) (rings ?b)) (when (wound ?b) (rings ?b))
    (not (wound ?b))))
(:action still :parameters (?b - bell) :precondition (rings ?b) :effect (not (rings ?b)))
(:action wind :parameters (?b - bell) :precondition () :effect (wound ?b))
(:action plug :parameters (?b - bell) :precondition (not (powered ?b)) :effect (powered ?b))
(:action unplug :parameters (?b - bell) :precondition (powered ?b) :effect (not (powered ?b))))
"""
"""One effect that comes about in two ways."""

VALVES = """
(define (domain valves)
(:requirements :typing :negative-preconditions :conditional-effects)
(:types valve tank)
(:predicates (open ?v - valve) (feeds ?v - valve ?t - tank) (wet ?t - tank))
(:action turn :parameters (?v - valve ?t - tank) :precondition (feeds ?v ?t)
  :effect (and (when (open ?v) (not (open ?v))) (when (not (open ?v)) (and (open ?v) (wet ?t)))))
(:action drain :parameters (?v - valve ?t - tank) :precondition (and (feeds ?v ?t) (open ?v))
  :effect (not (wet ?t))))
"""
"""An action that makes true what was false, and false what was true."""

OBJECTS = {
    "valves": {"v": "valve", "w": "valve", "s": "tank", "t": "tank"},
    "bells": {"a": "bell", "b": "bell"},
    "locks": {"c": "chamber", "d": "chamber", "b": "barge"},
    "post": {"v": "van", "w": "van", "x": "bike", "o": "letter"},
    "mine": {"a": "cell", "b": "cell"},
    "boats": {"b1": "boat", "b2": "boat", "c1": "car", "c2": "car", "p": "harbour", "q": "harbour"},
    "lamps": {"s1": "switch", "s2": "switch", "s3": "switch", "l1": "lamp", "l2": "lamp"},
}

STARTS = {
    "valves": frozenset({"feeds v s", "feeds w s", "feeds w t", "open v"}),
    "bells": frozenset({"wired a"}),
    "locks": frozenset({"water c low", "water d high", "waiting b low"}),
    "post": frozenset({"at x o", "free v", "free w", "paid o"}),
    "mine": frozenset({"loose a", "gold b"}),
    "boats": frozenset({"at b1 p", "at b2 home", "at c1 p", "at c2 q"}),
    "lamps": frozenset({"up s1", "up s2", "wired s1 l1", "wired s2 l1", "wired s3 l2"}),
}


def strips_of(text: str, folder: Path) -> Strips:
    """The domain of a text."""
    path = folder / "domain.pddl"
    path.write_text(text)
    return read_strips(path)


def instances(domain: Strips, objects: dict[str, str]) -> list[tuple[str, tuple[str, ...]]]:
    """All actions with all arguments of the right types, equal ones too."""
    free = Strips(
        domain.skeleton,
        {name: type(a)(a.name, a.parameters, (), ()) for name, a in domain.actions.items()},
    )
    return list(free.applicable(frozenset(), objects))


def walk(domain: Strips, steps: int, seed: int, *, failures: bool) -> Iterator[Step]:
    """Actions drawn at random; without failures from those that apply."""
    chance = np.random.default_rng(seed)
    objects = OBJECTS[domain.skeleton.name]
    everything = instances(domain, objects)
    state: State = STARTS[domain.skeleton.name]
    for _ in range(steps):
        good = sorted(domain.applicable(state, objects))
        choice = everything if failures else good
        name, arguments = choice[int(chance.integers(len(choice)))]
        done = (name, arguments) in good
        after = domain.actions[name].apply(state, arguments) if done else state
        yield Step(name, arguments, done, state, after)
        state = after
