"""What moves between pictures, as state files keep it."""

from app.files.state_models import MotionRecord, MovingRecord
from core.records.motion import Motion


def motion_record(motion: Motion | None) -> MotionRecord | None:
    """Return the record of a motion; ``None``: nothing moves."""
    if motion is None:
        return None
    objects = [MovingRecord(number=number, way=way) for number, way in motion.objects]
    return MotionRecord(camera=motion.camera, objects=objects)


def motion_of(record: MotionRecord | None) -> Motion | None:
    """Return the motion of a record; ``None``: nothing moves."""
    if record is None:
        return None
    return Motion(record.camera, tuple((each.number, each.way) for each in record.objects))
