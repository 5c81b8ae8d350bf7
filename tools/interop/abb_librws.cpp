// Calls abb_librws as a user of it would; each line of output is a call and what came of it.
//
//     abb_librws HOST PORT
#include <abb_librws/rws_interface.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <thread>

using namespace abb::rws;

static int failed = 0;
static RWSInterface* robot_now = nullptr;

static void call(const std::string& what, const std::function<bool()>& function)
{
  bool good = false;
  std::string why;
  // A controller takes 20 requests a second, and librws counts none.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  try
  {
    good = function();
  }
  catch (const std::exception& error)
  {
    why = std::string(": ") + error.what();
  }
  failed += good ? 0 : 1;
  if (!good && why.empty())
    why = ": " + robot_now->getLogTextLatestEvent(true);
  std::cout << (good ? "ok     " : "FAILED ") << what << why << std::endl;
}

int main(int, char** argv)
{
  RWSInterface robot(argv[1], static_cast<unsigned short>(std::atoi(argv[2])));
  robot_now = &robot;
  call("registerRemoteUser", [&] { return robot.registerRemoteUser("user", "librws", "here"); });
  call("collectRuntimeInfo", [&] { return robot.collectRuntimeInfo().rws_connected; });
  call("collectStaticInfo", [&] { return !robot.collectStaticInfo().rapid_tasks.empty(); });
  call("getSystemInfo", [&] {
    RWSInterface::SystemInfo info = robot.getSystemInfo();
    return !info.robot_ware_version.empty() && !info.system_name.empty() &&
           !info.system_type.empty() && !info.system_options.empty();
  });
  call("isAutoMode", [&] { return robot.isAutoMode().isTrue(); });
  call("isMotorsOn", [&] { return robot.isMotorsOn().isTrue(); });
  call("getRAPIDTasks", [&] { return robot.getRAPIDTasks().at(0).is_motion_task; });
  call("getRAPIDModulesInfo", [&] { return !robot.getRAPIDModulesInfo("T_ROB1").empty(); });
  call("getCFGPresentOptions", [&] { return !robot.getCFGPresentOptions().empty(); });
  call("getCFGMechanicalUnitGroups", [&] { return !robot.getCFGMechanicalUnitGroups().empty(); });
  call("getCFGMechanicalUnits", [&] { return !robot.getCFGMechanicalUnits().empty(); });
  call("getCFGArms", [&] { return !robot.getCFGArms().empty(); });
  call("getCFGJoints", [&] { return !robot.getCFGJoints().empty(); });
  call("getCFGRobots", [&] { return !robot.getCFGRobots().empty(); });
  call("getMechanicalUnitStaticInfo", [&] {
    RWSInterface::MechanicalUnitStaticInfo info;
    return robot.getMechanicalUnitStaticInfo("ROB_1", info) && info.axes == 6;
  });
  call("getMechanicalUnitDynamicInfo", [&] {
    RWSInterface::MechanicalUnitDynamicInfo info;
    return robot.getMechanicalUnitDynamicInfo("ROB_1", info) && info.tool_name == "tool0";
  });
  call("getMechanicalUnitJointTarget", [&] {
    JointTarget target;
    return robot.getMechanicalUnitJointTarget("ROB_1", &target);
  });
  call("getMechanicalUnitRobTarget", [&] {
    RobTarget target;
    return robot.getMechanicalUnitRobTarget("ROB_1", &target) && target.pos.z.value > 0;
  });
  call("setSpeedRatio", [&] { return robot.setSpeedRatio(40) && robot.getSpeedRatio() == 40; });
  call("setRAPIDSymbolData", [&] {
    RAPIDNum number(7);
    RAPIDNum back;
    return robot.setRAPIDSymbolData("T_ROB1", "MainModule", "x", number) &&
           robot.getRAPIDSymbolData("T_ROB1", "MainModule", "x", &back) && back.value == 7;
  });
  call("setIOSignal", [&] {
    return robot.setIOSignal("doGrip", "1") && robot.getIOSignal("doGrip") == "1";
  });
  RWSClient::FileResource file("librws.txt");
  call("uploadFile", [&] { return robot.uploadFile(file, "a text\n"); });
  call("getFile", [&] {
    std::string text;
    return robot.getFile(file, &text) && text == "a text\n";
  });
  call("deleteFile", [&] { return robot.deleteFile(file); });
  call("startSubscription", [&] {
    RWSClient::SubscriptionResources wanted;
    wanted.addIOSignal("doGrip", RWSClient::SubscriptionResources::HIGH);
    return robot.startSubscription(wanted);
  });
  call("waitForSubscriptionEvent", [&] {
    return robot.setIOSignal("doGrip", "0") && robot.waitForSubscriptionEvent();
  });
  call("endSubscription", [&] { return robot.endSubscription(); });
  call("stopRAPIDExecution", [&] { return robot.stopRAPIDExecution(); });
  call("resetRAPIDProgramPointer", [&] { return robot.resetRAPIDProgramPointer(); });
  call("setMotorsOff", [&] { return robot.setMotorsOff() && robot.isMotorsOn().isFalse(); });
  call("setMotorsOn", [&] { return robot.setMotorsOn() && robot.isMotorsOn().isTrue(); });
  call("startRAPIDExecution", [&] {
    return robot.startRAPIDExecution() && robot.isRAPIDRunning().isTrue();
  });
  return failed ? 1 : 0;
}
