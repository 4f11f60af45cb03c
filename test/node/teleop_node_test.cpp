// The keyboard teleoperation in a pseudo-terminal, as a user runs it, by the wall clock.
#include <mpm_ros/BodyStates.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace teleop_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr int kPlate = 0;

/// `teleop` in a terminal of its own.
class Teleop {
 public:
  explicit Teleop(std::vector<std::string> words) {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "teleop";
    words.insert(words.begin(), program.string());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (pid_ == 0) {
      execv(program.c_str(), arguments.data());
      _exit(127);
    }
    tcgetattr(terminal_, &before_);
  }
  ~Teleop() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(terminal_);
  }

  void press(char key) const { EXPECT_EQ(write(terminal_, &key, 1), 1); }
  void signal(int number) const { kill(pid_, number); }
  /// The output so far.
  const std::string& shown() {
    pollfd output{terminal_, POLLIN, 0};
    std::array<char, 4096> buffer{};
    while (poll(&output, 1, 0) > 0) {
      const ssize_t count = read(terminal_, buffer.data(), buffer.size());
      if (count <= 0) break;  // it has ended
      shown_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return shown_;
  }
  bool shows(const std::string& text) {
    return eventually([&] { return shown().find(text) != std::string::npos; });
  }
  /// Waits for the end and returns the exit code; -1 if it did not end in time, -2 if a signal ended it.
  int wait() {
    int status = 0;
    if (!eventually([&] {
          shown();
          return waitpid(pid_, &status, WNOHANG) == pid_;
        })) {
      return -1;
    }
    pid_ = 0;
    shown();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
  }
  bool is_raw() const { return (now().c_lflag & ICANON) == 0; }
  bool is_as_before() const { return now().c_lflag == before_.c_lflag && now().c_cc[VSUSP] == before_.c_cc[VSUSP]; }

 private:
  termios now() const {
    termios state{};
    tcgetattr(terminal_, &state);
    return state;
  }
  int terminal_ = -1;
  pid_t pid_ = 0;
  termios before_{};
  std::string shown_;
};

class Keyboard : public testing::Test {
 protected:
  SimulatorProcess simulator_{{kPress, "threads:=1", "set:=[time.end=1000]", "real_time_factor:=0.2"}};
  Ear<BodyStates> bodies_{simulator_.name("bodies")};

  void SetUp() override {
    ASSERT_TRUE(simulator_.ready()) << simulator_.log();
    ASSERT_TRUE(bodies_.hears(1)) << simulator_.log();
  }
  std::vector<std::string> arguments(const std::string& body) const {
    const std::string any = simulator_.name("x");
    return {body, "--namespace", any.substr(0, any.size() - 2), "--speed", "0.02"};
  }
  double speed() const { return bodies_.heard().back().bodies[kPlate].twist.linear.x; }
  /// Holds a key, repeated as by a keyboard, until the plate has the expected velocity.
  bool holds(const Teleop& teleop, char key, double expected) const {
    return eventually([&] {
      teleop.press(key);
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      return speed() == expected;
    });
  }
};

TEST_F(Keyboard, AKeyMovesTheBodyForAsLongAsItIsHeld) {
  Teleop teleop(arguments("plate"));
  ASSERT_TRUE(teleop.shows("space stops")) << teleop.shown();
  EXPECT_TRUE(teleop.is_raw());
  EXPECT_TRUE(holds(teleop, 'w', 0.02));
  EXPECT_TRUE(teleop.shows("velocity +0.02"));
  EXPECT_TRUE(eventually([&] { return speed() == 0.0; })) << speed();  // the key was released
  EXPECT_TRUE(holds(teleop, 's', -0.02));
  teleop.press(' ');
  EXPECT_TRUE(eventually([&] { return speed() == 0.0; }));
  teleop.press('q');
  EXPECT_EQ(teleop.wait(), 0);
  EXPECT_TRUE(teleop.is_as_before());
}

TEST_F(Keyboard, AnEndBySignalStopsTheBodyAndGivesTheTerminalBack) {
  for (const int number : {SIGTERM, SIGINT}) {
    Teleop teleop(arguments("plate"));
    ASSERT_TRUE(teleop.shows("space stops")) << teleop.shown();
    EXPECT_TRUE(holds(teleop, 'w', 0.02));
    teleop.signal(number);
    EXPECT_EQ(teleop.wait(), 0);
    EXPECT_TRUE(eventually([&] { return speed() == 0.0; }));
    EXPECT_TRUE(teleop.is_as_before());
  }
}

TEST_F(Keyboard, ABodyThatIsNotThereIsRefusedWithTheNearest) {
  Teleop teleop(arguments("plat"));
  EXPECT_EQ(teleop.wait(), 2);
  EXPECT_TRUE(teleop.shows("teleop: there is no rigid body 'plat'; did you mean 'plate'?")) << teleop.shown();
  std::vector<std::string> words = arguments("plate");
  words.erase(words.begin());
  Teleop unnamed(words);
  EXPECT_EQ(unnamed.wait(), 2);
  EXPECT_TRUE(unnamed.shows("which body? There are plate, rod")) << unnamed.shown();
}

}  // namespace teleop_node_test
}  // namespace mpm_ros::test
