// The subcommands of `isostat`. Each gets the arguments from its own name on and returns the exit code; bad input is
// thrown as InputError and becomes exit code 2 in main.
#pragma once

namespace isostat {

int pack_command(int argc, char** argv);
int study_command(int argc, char** argv);
int analyze_command(int argc, char** argv);
int info_command(int argc, char** argv);
int draw_command(int argc, char** argv);
int plot_command(int argc, char** argv);
int compare_command(int argc, char** argv);
int convert_command(int argc, char** argv);
int lab_command(int argc, char** argv);

// 0 done, 2 bad input or usage, 3 a stage did not meet its end, 4 internal error, 130 interrupted.
enum ExitCode { exit_done = 0, exit_bad_input = 2, exit_unfinished = 3, exit_internal = 4, exit_interrupted = 130 };

}  // namespace isostat
