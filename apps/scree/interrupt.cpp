#include "interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace scree {
namespace {

volatile std::sig_atomic_t noted = 0;

void note(int /*signal*/) { noted = 1; }

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  noted = 0;
  // SA_RESETHAND: the second signal meets the default again, which ends the program.
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, note, static_cast<int>(SA_RESETHAND) | SA_RESTART);
}

InterruptWatch::~InterruptWatch() {
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, SIG_DFL, 0);
}

bool InterruptWatch::interrupted() const { return noted != 0; }

}  // namespace scree
