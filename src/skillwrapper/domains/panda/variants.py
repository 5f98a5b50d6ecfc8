"""The table with other things, light and cameras, and with forces: the drawings of the domain."""

from __future__ import annotations

from skillwrapper.domains.panda.cameras import FAR, SIDE
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.objects import OTHERS
from skillwrapper.domains.panda.physical import PhysicalPandaEnvironment
from skillwrapper.domains.panda.table import Setting
from skillwrapper.domains.tabletop.physics import CLUMSINESS
from skillwrapper.domains.tabletop.stage import Lighting
from skillwrapper.world.domain import Domain


def other_things(domain: Domain) -> PandaEnvironment:
    """Another mug, teapot, plate, bowl and sponge."""
    return PandaEnvironment(Setting(look=OTHERS), domain=domain)


def from_the_side(domain: Domain) -> PandaEnvironment:
    """Seen from the robot's right."""
    return PandaEnvironment(camera=SIDE, domain=domain)


def from_afar(domain: Domain) -> PandaEnvironment:
    """Seen from farther away and higher up."""
    return PandaEnvironment(camera=FAR, domain=domain)


def in_dim_light(domain: Domain) -> PandaEnvironment:
    """With about half of the light."""
    return _lit(Lighting(strength=0.55), domain)


def in_bright_light(domain: Domain) -> PandaEnvironment:
    """With nearly half as much light again."""
    return _lit(Lighting(strength=1.4), domain)


def in_warm_light(domain: Domain) -> PandaEnvironment:
    """As in the evening."""
    return _lit(Lighting(warmth=1.0), domain)


def with_shadows(domain: Domain) -> PandaEnvironment:
    """With a lamp that casts shadows."""
    return _lit(Lighting(shadows=True), domain)


def by_forces(domain: Domain) -> PhysicalPandaEnvironment:
    """Moved by servos that do what they should."""
    return PhysicalPandaEnvironment(domain=domain)


def clumsy(domain: Domain) -> PhysicalPandaEnvironment:
    """Moved by servos, with poses seen wrongly and things that slip."""
    return PhysicalPandaEnvironment(CLUMSINESS, domain=domain)


def _lit(lighting: Lighting, domain: Domain) -> PandaEnvironment:
    return PandaEnvironment(Setting(lighting=lighting), domain=domain)
