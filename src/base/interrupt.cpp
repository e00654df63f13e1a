#include "base/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace windhover {
namespace {

constexpr std::initializer_list<int> signals = {SIGINT, SIGTERM, SIGUSR1};
volatile std::sig_atomic_t received = 0;

extern "C" void remember_signal(int signal) {
  received = signal;
  for (int any : signals) std::signal(any, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESTART;
  for (int signal : signals) sigaction(signal, &action, nullptr);
}

int interrupt_signal() { return received; }

}  // namespace windhover
