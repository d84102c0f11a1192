"""The planner's tuned numbers: docs/theory/steering.md says what halves and doubles of them do.

They are read where they are used, so that a study can put others in their place.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class PilotNumbers:
    """Of going from one planned field to the next; see ``magwire.navigate.pilot``.

    Attributes
    ----------
    programmes
        Programmes per planned feed, at most.
    settled
        Programmes end when the field changes by less than this, in the unit of fields.
    trust
        Largest change of a component of the field in one programme, in that unit.
    least_trust
        Smallest such bound.
    fresh
        Trust at a new feed, at least, of a wire on the wall, or in a tight vessel: its nodes have
        moved on.
    halvings
        How often a change of the field that makes things worse is halved, at most.
    beyond
        Programmes from beyond where nothing on the way was better, at most.
    missed
        Part of the lumen's radius, or of the margin, by which a constraint may be missed.
    slip
        Change of the tip's offset from one feed to the next that is a slip, in that radius.
    inertia
        Feed over which the field may follow what is asked for, in the model's reach.
    tries
        Tries of a feed at which the wire is lost, each with a larger margin before it.
    stiffer
        Eigenvalue for a retry, over the one with which the wire was lost.
    firm
        Eigenvalue, in stability margins, from which on a wire that was lost is made only a little
        stiffer.
    halves
        How often the way to a feed is halved, where the wall holds a wire that is lost.
    wedged
        Eigenvalue, in stability margins, of a wire that the wall holds fast.
    relaxing
        Part that stays of that larger margin from one planned feed to the next.
    """

    programmes: int = 8
    settled: float = 5e-3
    trust: float = 0.3
    least_trust: float = 2e-3
    fresh: float = 0.03
    halvings: int = 6
    beyond: int = 3
    missed: float = 0.1
    slip: float = 0.2
    inertia: float = 0.015
    tries: int = 12
    stiffer: float = 1.15
    firm: float = 500.0
    halves: int = 2
    wedged: float = 250.0
    relaxing: float = 0.95


@dataclass(frozen=True)
class ProgrammeNumbers:
    """Of the quadratic programme; see ``magwire.navigate.programme``.

    Attributes
    ----------
    penalty
        Price of missing a constraint: it is paid only where there is no other way.
    off_room
        Room for the tip in a field that is off, over the room in the field itself.
    most_room
        Such room at most, as a part of the distance to the wall.
    tolerance
        In tight vessels, miss of a constraint that counts as none, in the lumen's radius or the
        eigenvalue.
    """

    penalty: float = 300.0
    off_room: float = 1.3
    most_room: float = 0.85
    tolerance: float = 1e-3


@dataclass(frozen=True)
class SwingNumbers:
    """Of the search for a swing; see ``magwire.navigate.swing``.

    Attributes
    ----------
    spacing
        Between the places where the tip may start, in the lumen's radius.
    coarse
        Between the places where it may arrive, in that radius.
    finer
        Steps in which the start of a way that works is moved to less field, over ``spacing``.
    marginal
        Room for these places, over the room for the tip.
    bound
        Largest offset of the tip while the wire swings, in the lumen's radius.
    off
        Part of the field's tolerance that is asked for while the wire swings.
    support
        Eigenvalue above which the wall must be holding the wire, in stability margins.
    press
        Field in which the wire arrives, over the least that holds it there.
    sparse
        Feed between the fields that a course must also do with, in the model's reach.
    length
        Feed for the swing, in that length.
    lead
        Feed for the way to its start, in that length.
    step
        Time step of a trial [s].
    programmes
        Programmes for one place, at most.
    settled
        They end when the field changes by less than this, in the unit of fields.
    trust
        Largest change of a component of the field in one programme, in the unit of fields.
    halvings
        How often a change of the field that makes things worse is halved, at most.
    detour
        Field of a place on the way to others, over the largest that a swing may need.
    gain
        Part by which the field must be less to be worth another try.
    close
        Distance from a place at which the tip is there, in the lumen's radius.
    fine, patient, sharp
        ``spacing``, ``programmes`` and ``settled`` where coils may be off: fewer ways do.
    stiffer
        Factor of the margin, at most, from one programme to the next, where coils that are off,
        each by itself, would move the tip too far.
    uneven
        Largest offset of the tip where coils are off, before and after the swing, in the lumen's
        radius.
    uneven_bound
        The same while the wire swings.
    presses
        Steps from the least field that holds the wire to the one in which it arrives.
    early
        Part of the swing after which the field has its nudge.
    nudges
        Nudges that are tried where coils may be off, over the field at the start.
    shorter
        Feeds for the swing that are tried where coils may be off, over ``length``.
    """

    spacing: float = 0.36
    coarse: float = 0.24
    finer: tuple[float, ...] = (0.5, 0.25, 0.125)
    marginal: float = 1.15
    bound: float = 0.8
    off: float = 0.6
    support: float = 20.0
    press: float = 1.25
    sparse: float = 0.02
    length: float = 0.02
    lead: float = 0.04
    step: float = 0.02
    programmes: int = 6
    settled: float = 1e-2
    trust: float = 0.3
    halvings: int = 6
    detour: float = 1.5
    gain: float = 0.005
    close: float = 0.05
    fine: float = 0.12
    patient: int = 12
    sharp: float = 2e-3
    stiffer: float = 4.0
    uneven: float = 0.86
    uneven_bound: float = 0.93
    presses: int = 5
    early: float = 0.3
    nudges: tuple[float, ...] = (0.0, 0.07, -0.07, 0.1, -0.1)
    shorter: tuple[float, ...] = (0.25, 0.5, 1.0)


@dataclass(frozen=True)
class CourseNumbers:
    """Of the plan as a whole; see ``magwire.navigate.stable``.

    Attributes
    ----------
    reference
        Field of order one, in EI/(M L^2) with the model's reach as L.
    ahead
        Feed that the plan runs ahead, in that length.
    scout
        Feed beyond the plan's end in which the wall must come to hold the wire, in that.
    stride
        Planned feeds from one place where the wall holds the wire to the next that is tried.
    growth
        Factor of the field over a span with which another course is looked for.
    span
        That span of feed, in that length.
    """

    reference: float = 100.0
    ahead: float = 0.15
    scout: float = 0.15
    stride: int = 2
    growth: float = 2.0
    span: float = 0.1


@dataclass(frozen=True)
class RetryNumbers:
    """Of going back and trying again; see ``magwire.navigate.persistent``.

    Attributes
    ----------
    step
        How much farther back each attempt starts, in the lumen's radius.
    ahead
        How far before a junction, in that radius.
    past
        How far past a place it counts as passed, in that radius.
    strayed
        How far outside the path to the target a tip is in another branch, in that radius.
    """

    step: float = 4.0
    ahead: float = 1.0
    past: float = 2.0
    strayed: float = 0.2


@dataclass(frozen=True)
class SpikeNumbers:
    """Of other courses where the field of one has a spike; see ``magwire.navigate.foresight``.

    Attributes
    ----------
    over
        Peak field that counts as a spike, over the median along the way.
    lead, past
        Feed before the peak and after it, in the model's reach, in which the course is another one.
    farther, nearer
        What remains of the tip's clearance, and the part of its room that it gives up: two courses.
    gain
        Peak of another course at most, over the one that it is to replace.
    rounds
        Spikes that are looked at one after the other, at most.
    same_field, same_offset, same_stiffness
        Where the new course is as near to the old one as this, it goes on as that: in the unit of
        fields, in the lumen's radius, and the logarithm of the eigenvalues' ratio.
    """

    over: float = 4.0
    lead: float = 0.05
    past: float = 0.1
    farther: float = 0.5
    nearer: float = 0.25
    gain: float = 0.97
    rounds: int = 3
    same_field: float = 0.02
    same_offset: float = 0.03
    same_stiffness: float = 0.2


@dataclass(frozen=True)
class OutletNumbers:
    """Of a plan to an outlet; see ``magwire.planning``.

    Attributes
    ----------
    pace
        Feed between two planned fields, over the lower quartile of the radii of the path.
    finest
        That feed at most, over the wire's length.
    part
        Activation gap of the planning wall at most, over the clearance at the narrowest place.
    gap
        Activation gap of the planning wall at most [m].
    left
        Part of the gap that is left where the wire is bent around the sharpest bend.
    hard
        Stiffness of the wall's barrier, over Young's modulus of the wire, at least.
    attempts
        Attempts in one place.
    slack
        Feed at most, over the length of the path: a wire may lie on the outside of bends.
    nearer
        Parts of its room that the tip gives up where an outlet is missed, one tried after the
        other.
    """

    pace: float = 0.2
    finest: float = 5e-3
    part: float = 0.2
    gap: float = 8e-5
    left: float = 0.25
    hard: float = 1e-3
    attempts: int = 3
    slack: float = 1.1
    nearer: tuple[float, ...] = (0.25, 0.5)


PILOT = PilotNumbers()
PROGRAMME = ProgrammeNumbers()
SWING = SwingNumbers()
COURSE = CourseNumbers()
RETRY = RetryNumbers()
SPIKE = SpikeNumbers()
OUTLET = OutletNumbers()
