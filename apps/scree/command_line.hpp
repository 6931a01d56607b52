// From the arguments of the program to a subcommand.
#pragma once

namespace scree {

/// Parses the arguments and runs the subcommand that they name. Returns its exit code. @throws Error (usage) for
/// arguments that do not fit, with a suggestion; whatever the subcommand throws.
[[nodiscard]] int run_command_line(int argc, char** argv);

}  // namespace scree
