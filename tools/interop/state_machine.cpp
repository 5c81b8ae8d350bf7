// Uses ABB's StateMachine add-in through abb_librws; each line of output is a call and its result.
//
//     state_machine HOST PORT
#include <abb_librws/rws_state_machine_interface.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

using namespace abb::rws;

static const std::string TASK = "T_ROB1";

static void report(const std::string& what, bool good)
{
  std::cout << (good ? "ok     " : "FAILED ") << what << std::endl;
  // A controller takes 20 requests a second, and librws counts none.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
}

static bool wait_idle(RWSStateMachineInterface& robot)
{
  for (int i = 0; i < 60; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    if (robot.services().main().isStateIdle(TASK).isTrue())
      return true;
  }
  return false;
}

static bool stands_at(RWSStateMachineInterface& robot, float axis_1, float axis_5)
{
  JointTarget place;
  return robot.getMechanicalUnitJointTarget("ROB_1", &place) &&
         std::abs(place.robax.rax_1.value - axis_1) < 0.01 &&
         std::abs(place.robax.rax_5.value - axis_5) < 0.01;
}

int main(int, char** argv)
{
  RWSStateMachineInterface robot(argv[1], static_cast<unsigned short>(std::atoi(argv[2])));
  const auto& services = robot.services();
  report("collectRuntimeInfo", robot.collectRuntimeInfo().rws_connected);
  report("collectStaticInfo", !robot.collectStaticInfo().rapid_tasks.empty());
  report("isStateIdle", wait_idle(robot));
  SpeedData speed;
  speed.v_tcp.value = 1000;
  speed.v_ori.value = 500;
  speed.v_leax.value = 5000;
  speed.v_reax.value = 1000;
  report("setMoveSpeed", services.rapid().setMoveSpeed(TASK, speed));
  JointTarget target;
  target.robax.rax_1.value = 20;
  target.robax.rax_5.value = 30;
  report("runMoveAbsJ", services.rapid().runMoveAbsJ(TASK, target));
  report("the target is reached", wait_idle(robot) && stands_at(robot, 20, 30));
  report("runMoveToCalibrationPosition", services.rapid().runMoveToCalibrationPosition(TASK));
  report("the calibration position is reached", wait_idle(robot) && stands_at(robot, 0, 0));
  report("setRoutineName", services.rapid().setRoutineName(TASK, "wave"));
  report("signalRunRAPIDRoutine", services.rapid().signalRunRAPIDRoutine());
  report("the routine has run", wait_idle(robot) && stands_at(robot, 10, 30));
  RWSStateMachineInterface::EGMSettings settings;
  report("EGM getSettings", services.egm().getSettings(TASK, &settings));
  settings.run.cond_time.value = 7;
  report("EGM setSettings", services.egm().setSettings(TASK, settings));
  RWSStateMachineInterface::EGMSettings again;
  const bool read = services.egm().getSettings(TASK, &again);
  report("they are stored", read && again.run.cond_time.value == 7);
  return 0;
}
