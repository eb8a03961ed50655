"""What the People page does to the state: whom the face is mixed with, and between which expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from facemorph.core.morph import Curve
from facemorph.core.pose import NEUTRAL, State, state_of
from facemorph.core.progress import Progress
from facemorph.core.rig import EXPRESSION, Rig, plain_label
from facemorph.deform.controls import PeopleControl
from facemorph.deform.people import People, PeopleMix
from facemorph.ui import files
from facemorph.ui.actions import tell_error
from facemorph.ui.methods import OWN
from facemorph.ui.people_page import Corner, PictureKey
from facemorph.ui.state import App, Face, same_head
from facemorph.ui.words import NEUTRAL_LABEL, label_of, percent, state_words

JOB = "person"


def control(app: App) -> PeopleControl:
    """What the page is set to; untouched, it goes from neutral to the first expression that all have."""
    kept = app.controls.people
    if kept.source or kept.target:
        return kept
    names = [name for name in expressions(app) if name != NEUTRAL]
    return replace(kept, target=state_of(names[0])) if names else kept


def change(app: App, changed: PeopleControl) -> None:
    """Set the page."""
    if changed != app.controls.people:
        app.controls = replace(app.controls, people=changed)


def reset(app: App) -> None:
    """The face itself, without expression; nobody to mix it with."""
    change(app, PeopleControl())


def moves(app: App) -> bool:
    """Whether the page does anything, were it switched on."""
    kept = app.controls.people
    return bool(kept.weights()) or mixes(app)


def mixes(app: App) -> bool:
    """Whether another person is in what the page makes."""
    return shares(app).keys() != {OWN}


def shares(app: App) -> dict[str, float]:
    """Each person's share of the face, by name."""
    mix = app.controls.people.mix
    return {OWN: 1.0} if mix is None else mix.weights()


def others(app: App) -> tuple[str, ...]:
    """Everybody beside the face itself who is in the mixture or its goal."""
    mix = app.controls.people.mix
    return () if mix is None else tuple(n for n in dict.fromkeys([*mix.source, mix.target]) if n != OWN)


def expressions(app: App) -> dict[str, str]:
    """Name -> words of the expressions that the face and everybody mixed with it have, neutral first."""
    if app.rig is None:
        return {}
    lacking = lacked(app)
    labels = {shape.name: shape.label for shape in app.rig.shapes_in(EXPRESSION)}
    return {NEUTRAL: NEUTRAL_LABEL, **{n: words for n, words in labels.items() if n not in lacking}}


def lacked(app: App) -> dict[str, str]:
    """Expressions of the face that somebody mixed with it lacks -> who that is."""
    if app.rig is None:
        return {}
    people = {name: app.methods.people[name] for name in others(app) if name in app.methods.people}
    return {
        shape.name: name
        for name, rig in people.items()
        for shape in app.rig.shapes_in(EXPRESSION)
        if shape.name not in rig.names
    }


def put(app: App, s: float, t: float) -> None:
    """Both places at once, each 0..1; without another person there is no s."""
    kept = control(app)
    mix = None if kept.mix is None else kept.mix.at(_inside(s))
    if (mix, _inside(t)) != (app.controls.people.mix, app.controls.people.t):
        change(app, replace(kept, mix=mix, t=_inside(t)))


def _inside(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def set_curve(app: App, curve: Curve) -> None:
    """How t eases."""
    change(app, replace(app.controls.people, curve=curve))


def toggle_skins(app: App) -> None:
    """Mix the colours too, or keep the face's own."""
    change(app, replace(app.controls.people, skins=not app.controls.people.skins))


def choose_target(app: App, name: str) -> None:
    """The expression shown becomes the source, `name` the goal, t starts again: no jump (2.11)-(2.12)."""
    kept = control(app)
    shown = kept.weights()
    if shown == state_of(name):
        _already(app, expressions(app).get(name, name).lower())
        return
    change(app, replace(kept, source=shown, target=state_of(name), t=0.0))


def choose_source(app: App, name: str) -> None:
    """Set the source by hand; where it is the goal already, both ends change places and nothing moves."""
    kept = control(app)
    if kept.target == state_of(name):
        change(app, replace(kept, source=kept.target, target=kept.source, t=1.0 - kept.t))
    elif kept.source != state_of(name):
        change(app, replace(kept, source=state_of(name)))


def choose(app: App, name: str) -> None:
    """What is shown becomes the source, the person called `name` the goal, s starts again: no jump (2.11)."""
    mix = app.controls.people.mix or PeopleMix({OWN: 1.0}, OWN)
    if mix.weights() == {name: 1.0}:
        _already(app, called(app, name))
    elif name != mix.target or mix.s != 0.0:
        change(app, replace(app.controls.people, mix=mix.rebased(name)))


def _already(app: App, words: str) -> None:
    app.messages.tell(f"What the page People makes is {words} already.")


def can_swap(app: App) -> bool:
    """Both ends are single people."""
    mix = app.controls.people.mix
    return mix is not None and len(mix.source) == 1


def swap(app: App) -> None:
    """Both people change places; the face stays as it is."""
    mix = app.controls.people.mix
    if mix is not None and can_swap(app):
        (name,) = mix.source
        swapped = PeopleMix({mix.target: 1.0}, name, 1.0 - mix.s)
        change(app, replace(app.controls.people, mix=swapped))


def can_start_again(app: App) -> bool:
    """The mixture does not begin with the face itself, or has left it."""
    mix = app.controls.people.mix
    return mix is not None and (mix.s != 0.0 or mix.source.keys() != {OWN})


def start_again(app: App) -> None:
    """From the face itself to the same other person; the expression stays."""
    mix = app.controls.people.mix
    if mix is not None:
        again = None if mix.target == OWN else PeopleMix({OWN: 1.0}, mix.target)
        change(app, replace(app.controls.people, mix=again))


def ask_builtin(app: App, name: str) -> None:
    """Mix the face with a built-in person."""
    if app.face is not None and app.face.builtin and app.face.source == (name,):
        choose(app, OWN)
    else:
        _ask(app, (name,), plain_label(name), builtin=True)


def ask_files(app: App, source: Sequence[str], *, anew: bool = False) -> None:
    """Mix the face with the person in a folder or in files, read again where `anew`."""
    paths = tuple(str(Path(path).absolute()) for path in source)
    known = "" if anew else app.pages.people.files.get(paths, "")
    _ask(app, paths, known or files.short(paths), builtin=False)


def _ask(app: App, paths: tuple[str, ...], title: str, *, builtin: bool) -> None:
    """Read a person beside the window, see whether the faces fit, and only then change anything."""
    face, page = app.face, app.pages.people
    if face is None:
        return
    known = builtin or page.files.get(paths) == title
    kept = app.methods.people.get(title) if known else None
    page.loading = title

    def work(progress: Progress) -> Rig:
        rig = kept if kept is not None else files.load(paths, progress, builtin=builtin)
        progress(1.0, "Comparing the two")
        People({OWN: face.rig, title: rig})
        return rig

    def done(rig: Rig) -> None:
        page.loading = ""
        if same_head(face, app.face):
            _take(app, face, rig, paths, title if builtin or kept is not None else "")

    def failed(error: BaseException) -> None:
        page.loading = ""
        tell_error(app, f"{title} cannot be mixed with {face.title}", error)

    app.jobs.start(f"Opening {title}", work, done, failed, kind=JOB)


def loading(app: App) -> str:
    """Who is being read now, "" for nobody."""
    return app.pages.people.loading if app.jobs.of_kind(JOB) else ""


def _take(app: App, face: Face, rig: Rig, paths: tuple[str, ...], name: str) -> None:
    """Mix with a person who was read, where they have what the face shows."""
    used = _used(app)
    missing = [shape for shape in used if shape not in rig.names]
    if missing:
        words = label_of(face.rig, missing[0])
        app.messages.fail(
            f"{name or rig.info.name} has no {words}, which the face shows or the page goes to. "
            "Take it out first, then choose this person again."
        )
        return
    if not name:
        name = _new_name(app, rig.info.name or files.short(paths))
        app.pages.people.remember(paths, name)
    if app.methods.people.get(name) is not rig:
        app.methods.people[name] = rig
        app.methods.forget()
    choose(app, name)
    _let_go(app)


def _used(app: App) -> list[str]:
    """Shapes that a person in the mixture must have: those shown, and both ends of the page's way."""
    kept = app.controls.people
    return list(dict.fromkeys([*app.shown_state(), *kept.source, *kept.target]))


def _new_name(app: App, wanted: str) -> str:
    """`wanted`, or with a number where another person of this name could be meant."""
    taken = {OWN, *app.methods.people, *(plain_label(name) for name in app.builtins)}
    name, number = wanted, 2
    while name in taken:
        name, number = f"{wanted} ({number})", number + 1
    return name


def _let_go(app: App) -> None:
    """Forget people whom neither the face nor any step of undo needs."""
    needed = {*others(app), *app.history.people()}
    for name in [name for name in app.methods.people if name not in needed]:
        del app.methods.people[name]


def called(app: App, name: str) -> str:
    """What a person is called in words."""
    return app.face.title if name == OWN and app.face else name


def mixture_words(app: App, weights: Mapping[str, float], most: int = 2) -> str:
    """People in a few words: `Ada`, `Ada 60 % + Kofi 40 %`, `Ada 50 % + Kofi 30 % + 1 more`."""
    parts = sorted(weights.items(), key=lambda part: -part[1])
    parts = [part for part in parts if round(part[1] * 100)]
    if len(parts) == 1:
        return called(app, parts[0][0])
    words = [f"{called(app, name)} {percent(weight)}" for name, weight in parts[:most]]
    return " + ".join([*words, f"{len(parts) - most} more"] if len(parts) > most else words)


def corner_words(app: App, s: int, t: int) -> tuple[str, str]:
    """Who and in which expression stands in the pad's corner at (s, t), each 0 or 1."""
    kept = control(app)
    weights = {OWN: 1.0} if kept.mix is None else kept.mix.at(float(s)).weights()
    return mixture_words(app, weights), expression_words(app, kept.target if t else kept.source)


def picture_keys(app: App) -> dict[Corner, PictureKey]:
    """What the pictures of the pad's corners depend on; without another person there is no right side."""
    if app.rig is None:
        return {}
    kept, keys = control(app), dict[Corner, PictureKey]()
    for s in (0, 1) if kept.mix else (0,):
        weights = {OWN: 1.0} if kept.mix is None else kept.mix.at(float(s)).weights()
        rigs = {OWN: app.rig, **app.methods.people}
        heads = tuple((rigs[name].neutral, weights[name]) for name in sorted(weights) if name in rigs)
        for t in (0, 1):
            state = tuple(sorted((kept.target if t else kept.source).items()))
            keys[s, t] = (app.rig.neutral, heads, state, kept.skins)
    return keys


def expression_words(app: App, state: State) -> str:
    """A state in a few words."""
    return state_words(app.rig, state) if app.rig else NEUTRAL_LABEL
