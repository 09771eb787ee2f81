//! Exit code only.

fn main() -> std::process::ExitCode {
    ensonify::cli::main()
}
