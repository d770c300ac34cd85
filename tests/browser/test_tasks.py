"""A driving task: its course on the map, what its judge says, the score, and the class's best."""

import json

import pytest

from .conftest import ROBOT

COURSE_COLOR = "#c4a3ff"  # of the goal, in the dark
COURSE = """markers:
- {action: 3}
- {header: {frame_id: map}, ns: course, type: 4, scale: {x: 0.01}, points: [{x: 0.0}, {x: 0.5}]}
- {header: {frame_id: map}, ns: goal, scale: {x: 0.1}, pose: {position: {x: 0.5}, orientation: {w: 1.0}}}"""
TASK = """{{name: stand_in, message: "{message}", values: [{{key: title, value: "One <b>metre</b>"}},
  {{key: state, value: {state}}}, {{key: seconds, value: "3.4"}}, {{key: score, value: "87.3"}},
  {{key: driver, value: "<b>Ada</b>"}}, {{key: sentences, value: '{sentences}'}}, {{key: lost, value: "12.5"}}]}}"""
LATE = [{"code": "slow", "template": "took {seconds} s", "arguments": {"seconds": "<b>9</b>"}}]


@pytest.fixture
def judge(world):
    """A function that starts a stand-in for a judge of ROBOT; what it started before is killed."""
    processes = []

    def kill():
        while processes:
            world.kill(processes.pop())

    def start(state, message, sentences=()):
        kill()
        processes.append(world.publish(f"/{ROBOT}/task_course", "visualization_msgs/MarkerArray", COURSE))
        processes.append(world.publish(f"/{ROBOT}/task", "diagnostic_msgs/DiagnosticStatus",
                                       TASK.format(state=state, message=message, sentences=json.dumps(sentences))))
    start.kill = kill
    yield start
    kill()


def shows_goal(page):
    return page.shows_on_map(COURSE_COLOR)


def test_a_task_is_shown_while_its_judge_runs_and_a_score_until_the_robot_is_put_back(page, pupil, judge, world):
    page.media(prefers_color_scheme="dark")
    assert not shows_goal(page)
    judge("ready", "Drive when you are ready.")
    page.wait_for_text("task", "Drive when you are ready.")
    page.wait_for(lambda: shows_goal(page), "the goal on the map")
    assert "One <b>metre</b>" in page.text("task"), "a title is text"
    judge.kill()
    page.wait_for(lambda: not (shows_goal(page) or page.text("task")), "the goal and the task to vanish")
    judge("done", "in English", LATE)
    page.wait_for_text("task-result", "87.3 points, 3.4 s")
    page.wait_for_text("task-text", "Largest loss: took <b>9</b> s (12.5 points).")
    spoken = page.element("task-news").get_attribute("textContent")
    assert spoken == "One <b>metre</b>: 87.3 points, 3.4 s. Largest loss: took <b>9</b> s (12.5 points)."
    judge.kill()
    pupil.click("#show-scores")
    pupil.wait_for_text("scores", "87.3")
    assert pupil.fits("stop", "close-scores") and f"<b>Ada</b> ({ROBOT})" in pupil.text("scores")
    pupil.click("#close-scores")
    world.drive(page, ROBOT)
    page.lift()
    world.wait_for_stop(ROBOT)
    assert page.text("task")
    pupil.run("window.told = []; const notice = document.getElementById('notice');"
              "new MutationObserver(() => told.push(notice.textContent)).observe(notice, {childList: true})")
    page.click("#reset")
    for each in page, pupil:
        each.wait_for(lambda each=each: not each.text("task"), "the score to be gone")
    assert not pupil.run("return told"), "who did not drive it is not told"
    assert page.element("show-scores").is_displayed(), "the best stay"
