// Whether there is a master, asked before ros::init(): with private parameters on its command line that call writes to
// the master, and waits for one without a limit.
#pragma once

namespace mpm_ros {

/// Asks once, at the address that the command line (__master:=) or the environment gives, as ros::init() will;
/// ros::master::getURI() then says which. Waits only for a master that takes the call and does not answer.
bool master_answers(int argc, const char* const* argv);

}  // namespace mpm_ros
