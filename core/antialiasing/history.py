"""What temporal antialiasing does to the colours that it has kept before a new picture is mixed in."""

from core.antialiasing.temporal import HistoryRule, blended_history
from core.methods import method


@method(
    "history",
    "kept",
    "Kept where it was",
    source="Yang, Liu and Salvi 2020, A survey of temporal antialiasing techniques",
    exact_for="scenes at rest: the mean of all pictures as long as the share is 1/k",
    breaks_where="everything that moves: it leaves a ghost behind, for 53 pictures at a share of 0.1",
    listing=blended_history,
)
def kept_history() -> HistoryRule:
    """Mix each new colour with what the same pixel had."""
    return HistoryRule(follows_camera=False, is_clamped=False)


@method(
    "history",
    "reprojected",
    "Reprojected by depth",
    source="Yang, Liu and Salvi 2020, A survey of temporal antialiasing techniques",
    exact_for="scenes at rest, and where the camera alone moves, up to the blur of looking up between pixels",
    breaks_where="objects that move: the depth tells where a point was only if it stood still",
    listing=blended_history,
)
def reprojected_history() -> HistoryRule:
    """Look the history up where the point that a pixel shows was in the picture before."""
    return HistoryRule(follows_camera=True, is_clamped=False)


@method(
    "history",
    "clamped",
    "Reprojected, clamped to 3 x 3",
    source="Karis 2014, High quality temporal supersampling",
    exact_for="ghosts: what no new colour around has is gone at once",
    breaks_where="details thinner than a pixel: where no sample around hits one it is lost at once, so it flickers",
    listing=blended_history,
)
def clamped_history() -> HistoryRule:
    """The same, limited to the range of the 3 x 3 new colours around."""
    return HistoryRule(follows_camera=True, is_clamped=True)
