// Starts and stops EGM of ABB's StateMachine add-in through abb_librws, and guides the robot with
// abb_libegm; each line of output is a step and its result.
//
//     state_machine_egm HOST RWS_PORT EGM_PORT
#include <abb_libegm/egm_controller_interface.h>
#include <abb_librws/rws_state_machine_interface.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>

using namespace abb;

static const std::string TASK = "T_ROB1";

static bool report(const std::string& what, bool good)
{
  std::cout << (good ? "ok     " : "FAILED ") << what << std::endl;
  // A controller takes 20 requests a second, and librws counts none.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  return good;
}

static bool wait_idle(rws::RWSStateMachineInterface& robot)
{
  for (int i = 0; i < 60; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    if (robot.services().main().isStateIdle(TASK).isTrue())
      return true;
  }
  return false;
}

static double axis_1(rws::RWSStateMachineInterface& robot)
{
  rws::JointTarget place;
  return robot.getMechanicalUnitJointTarget("ROB_1", &place) ? place.robax.rax_1.value : NAN;
}

// Turns axis 1, or moves along y, by a distance within 400 frames, and holds for 200.
static bool guide(egm::EGMControllerInterface& guided, bool joints, double distance)
{
  egm::wrapper::Input input;
  egm::wrapper::Output output;
  double start = 0.0, now = 0.0;
  bool first = true;
  for (int i = 0; i < 600; ++i)
  {
    if (!guided.waitForMessage(2000))
      return false;
    guided.read(&input);
    if (input.status().egm_state() != egm::wrapper::Status::EGM_RUNNING)
    {
      --i;
      continue;
    }
    const auto& feedback = input.feedback().robot();
    now = joints ? feedback.joints().position().values(0) : feedback.cartesian().pose().position().y();
    if (first)
    {
      start = now;
      output.mutable_robot()->mutable_joints()->mutable_position()->CopyFrom(
          feedback.joints().position());
      output.mutable_robot()->mutable_cartesian()->mutable_pose()->CopyFrom(
          feedback.cartesian().pose());
      first = false;
    }
    const double wanted = start + distance * std::min(1.0, i / 400.0);
    if (joints)
      output.mutable_robot()->mutable_joints()->mutable_position()->set_values(0, wanted);
    else
      output.mutable_robot()->mutable_cartesian()->mutable_pose()->mutable_position()->set_y(wanted);
    guided.write(output);
  }
  return std::abs(now - start - distance) < 0.5;
}

int main(int, char** argv)
{
  rws::RWSStateMachineInterface robot(argv[1], static_cast<unsigned short>(std::atoi(argv[2])));
  const auto& services = robot.services();
  boost::asio::io_service service;
  egm::EGMControllerInterface guided(service, static_cast<unsigned short>(std::atoi(argv[3])));
  report("EGM port opened", guided.isInitialized());
  std::thread thread([&service] { service.run(); });
  report("isStateIdle", wait_idle(robot));
  rws::SpeedData speed;
  speed.v_tcp.value = 1000;
  speed.v_ori.value = 500;
  services.rapid().setMoveSpeed(TASK, speed);
  rws::JointTarget target;
  target.robax.rax_5.value = 30;
  report("runMoveAbsJ", services.rapid().runMoveAbsJ(TASK, target) && wait_idle(robot));
  rws::RWSStateMachineInterface::EGMSettings settings;
  report("EGM getSettings", services.egm().getSettings(TASK, &settings));
  settings.activate.max_speed_deviation.value = 40;
  settings.run.cond_time.value = 600;
  report("EGM setSettings", services.egm().setSettings(TASK, settings));

  report("signalEGMStartJoint", services.egm().signalEGMStartJoint());
  report("joints guided", guide(guided, true, 10.0));
  report("signalEGMStop", services.egm().signalEGMStop());
  report("idle again", wait_idle(robot));
  const double stopped = axis_1(robot);
  report("the robot is where it was guided", std::abs(stopped - 10.0) < 0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  report("it stands", std::abs(axis_1(robot) - stopped) < 1e-6);

  report("signalEGMStartPose", services.egm().signalEGMStartPose());
  report("the TCP guided", guide(guided, false, -30.0));
  report("signalEGMStop", services.egm().signalEGMStop());
  report("idle again", wait_idle(robot));
  report("runMoveAbsJ after EGM", services.rapid().runMoveAbsJ(TASK, target) && wait_idle(robot));
  report("the target is reached", std::abs(axis_1(robot)) < 0.01);
  service.stop();
  thread.join();
  return 0;
}
