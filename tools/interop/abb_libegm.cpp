// Guides a robot with abb_libegm; each line of output is a step and its result.
//
//     abb_libegm joint|pose|trajectory PORT
#include <abb_libegm/egm_controller_interface.h>
#include <abb_libegm/egm_trajectory_interface.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>

using namespace abb::egm;

static bool report(const std::string& what, bool good)
{
  std::cout << (good ? "ok     " : "FAILED ") << what << std::endl;
  return good;
}

template <typename Interface>
static bool wait_connected(Interface& robot)
{
  for (int i = 0; i < 600 && !robot.isConnected(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return robot.isConnected();
}

// A sine around the start in one coordinate; returns its largest measured deviation.
static void controlled(boost::asio::io_service& service, unsigned short port, bool joints)
{
  BaseConfiguration configuration;
  configuration.use_velocity_outputs = !joints;
  EGMControllerInterface robot(service, port, configuration);
  report("port opened", robot.isInitialized());
  std::thread thread([&service] { service.run(); });
  if (report("connected", wait_connected(robot)))
  {
    wrapper::Input input;
    wrapper::Output output;
    double start = 0.0, largest = 0.0, end = 0.0;
    bool first = true, known = false;
    int missed = 0;
    const double amplitude = joints ? 5.0 : 20.0;
    for (int i = 0; i < 1000; ++i)
    {
      if (!robot.waitForMessage(500))
      {
        ++missed;
        continue;
      }
      robot.read(&input);
      const auto& feedback = input.feedback().robot();
      const double now = joints ? feedback.joints().position().values(0)
                                : feedback.cartesian().pose().position().y();
      if (first || input.header().sequence_number() == 0)
      {
        start = now;
        output.mutable_robot()->mutable_joints()->mutable_position()->CopyFrom(
            feedback.joints().position());
        output.mutable_robot()->mutable_cartesian()->mutable_pose()->CopyFrom(
            feedback.cartesian().pose());
        output.mutable_robot()->mutable_cartesian()->mutable_velocity()->CopyFrom(
            feedback.cartesian().velocity());
        first = false;
      }
      known = input.header().rw_version() == wrapper::Header::RW_6_10_AND_NEWER;
      // Five full periods of 200 frames: the robot ends where it began.
      const double angle = 2.0 * M_PI * i / 400.0;
      const double wanted = start + amplitude * std::sin(angle) * (i < 800 ? 1.0 : 0.0);
      if (joints)
        output.mutable_robot()->mutable_joints()->mutable_position()->set_values(0, wanted);
      else
      {
        auto* pose = output.mutable_robot()->mutable_cartesian()->mutable_pose();
        pose->mutable_position()->set_y(wanted);
        auto* linear = output.mutable_robot()->mutable_cartesian()->mutable_velocity()->mutable_linear();
        linear->set_x(0.0);
        linear->set_z(0.0);
        linear->set_y(i < 800 ? amplitude * std::cos(angle) * 2.0 * M_PI / 1.6 : 0.0);
      }
      robot.write(output);
      largest = std::max(largest, std::abs(now - start));
      end = now;
    }
    report("release recognised", known);
    report("no message missed", missed == 0);
    report("amplitude reached", largest > 0.5 * amplitude && largest < 1.2 * amplitude);
    report("back at the start", std::abs(end - start) < 0.2);
  }
  service.stop();
  thread.join();
}

static void trajectory(boost::asio::io_service& service, unsigned short port)
{
  EGMTrajectoryInterface robot(service, port);
  report("port opened", robot.isInitialized());
  std::thread thread([&service] { service.run(); });
  if (report("connected", wait_connected(robot)))
  {
    wrapper::trajectory::TrajectoryGoal goal;
    for (const double axis : {8.0, -8.0, 0.0})
    {
      auto* point = goal.add_points();
      for (const double value : {axis, 0.0, 0.0, 0.0, 30.0, 0.0})
        point->mutable_robot()->mutable_joints()->mutable_position()->add_values(value);
      point->set_reach(true);
      point->set_duration(1.5);
    }
    robot.addTrajectory(goal);
    wrapper::trajectory::ExecutionProgress progress;
    double least = 0.0, most = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (!robot.retrieveExecutionProgress(&progress))
        continue;
      const double now = progress.inputs().feedback().robot().joints().position().values(0);
      least = std::min(least, now);
      most = std::max(most, now);
      if (i > 50 && !progress.goal_active())
        break;
    }
    report("trajectory ended", !progress.goal_active());
    report("both turning points", most > 7.5 && least < -7.5);
  }
  service.stop();
  thread.join();
}

int main(int, char** argv)
{
  const std::string mode = argv[1];
  const auto port = static_cast<unsigned short>(std::atoi(argv[2]));
  boost::asio::io_service service;
  if (mode == "trajectory")
    trajectory(service, port);
  else
    controlled(service, port, mode == "joint");
  return 0;
}
