#include "Interrupt.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace gnomon::client {
namespace {

constexpr unsigned graceSeconds = 5;

// A signal handler can reach nothing but what is static.
volatile std::sig_atomic_t signalled = 0;

extern "C" void noteSignal(int) {
    signalled = 1;
    ::alarm(graceSeconds);  // SIGALRM ends the program unless Interrupt ends first
}

void handle(int number, void (*handler)(int), int flags) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    ::sigaction(number, &action, nullptr);
}

}  // namespace

Interrupt::Interrupt() {
    signalled = 0;
    for (const int number : {SIGINT, SIGTERM})
        handle(number, noteSignal, static_cast<int>(SA_RESETHAND | SA_RESTART));
}

Interrupt::~Interrupt() {
    for (const int number : {SIGINT, SIGTERM}) handle(number, SIG_DFL, 0);
    ::alarm(0);
}

bool Interrupt::requested() const noexcept { return signalled != 0; }

}  // namespace gnomon::client
