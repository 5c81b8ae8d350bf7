"""What was commanded and what was executed, recorded by the controller's clock, and drawn."""

from rapidgen.client import Trajectory
from rapidgen.viewer import plot
from trying import robot_of

with robot_of("irb120", feedback=True) as robot:
    here = robot.state.joints
    points = [here, [value + 0.15 for value in here], here]
    path = Trajectory.from_points(points, seconds=0.8, names=robot.group.names).resampled(0.1)
    with robot.recording() as recording:
        robot.execute(path).result()

recording.to_csv("executed.csv")
picture = plot(path, recording, title="commanded and executed")
print(picture.save("executed.svg"))  # or .png; .html can be zoomed
difference = picture.charts[-1]
print(
    difference.title, f"{max(abs(c.values).max() for c in difference.curves):.3f} degrees at most"
)
