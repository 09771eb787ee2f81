//! `ensonify job`: ready scripts for the engines that clusters run.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Code, RecipeArgs};

/// An engine that starts many processes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Engine {
    /// An array job with a finishing job behind it: sbatch
    Slurm,
    /// An Indexed Job and a finishing Job: kubectl apply
    K8s,
    /// A Snakefile
    Snakemake,
    /// A shell script for GNU parallel
    Parallel,
}

/// Prints a ready script that renders a recipe in shards
///
/// The script can be started again after whatever happened: it goes on where it stopped.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  ensonify job slurm survey.yaml --shards 16 --cpus 8 > survey.sh && sbatch survey.sh\n  \
    ensonify job k8s survey.yaml --shards 16 --image registry/ensonify:0.1 | kubectl apply -f -"
)]
pub struct Job {
    /// The engine
    engine: Engine,
    #[command(flatten)]
    recipe: RecipeArgs,
    /// How many processes share the work
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=99_999))]
    shards: u32,
    /// Folder of the dataset [default: out/NAME]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Processors of each shard
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=1024))]
    cpus: u16,
    /// Memory of each shard, as the engine writes it
    #[arg(long, default_value = "4G")]
    memory: String,
    /// Slurm: time limit of each task
    #[arg(long, default_value = "04:00:00", value_name = "HH:MM:SS")]
    time: String,
    /// Kubernetes: container image with `ensonify` in it
    #[arg(long, default_value = "ensonify:latest")]
    image: String,
    /// Kubernetes: persistent volume claim with recipe, catalogs and dataset
    #[arg(long, default_value = "ensonify")]
    claim: String,
}

/// How an engine quotes the words of a command.
type Quote = fn(&str) -> String;

impl Job {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let header = &project.plan.header;
        let frames = project.plan.jobs.len();
        let folder = self.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&header.name));
        let folder = folder.to_string_lossy();
        let (template, quote): (&str, Quote) = match self.engine {
            Engine::Slurm => (include_str!("../../templates/jobs/slurm.sh"), shell),
            Engine::K8s => (include_str!("../../templates/jobs/kubernetes.yaml"), json),
            Engine::Snakemake => (include_str!("../../templates/jobs/Snakefile"), json),
            Engine::Parallel => (include_str!("../../templates/jobs/parallel.sh"), shell),
        };
        // Snakemake's commands are text in a text: the shell's quotes there, its own braces doubled.
        let word = |text: &str| match self.engine {
            Engine::Snakemake => {
                shell(text).replace('{', "{{").replace('}', "}}").replace('\\', "\\\\").replace('"', "\\\"")
            }
            Engine::Slurm | Engine::K8s | Engine::Parallel => quote(text),
        };
        let separator = if self.engine == Engine::K8s { ", " } else { " " };
        let recipe =
            [self.recipe.plan.as_ref().map(|_| "--plan".to_owned()), Some(word(&self.recipe.file().to_string_lossy()))];
        let recipe = recipe.into_iter().flatten().collect::<Vec<_>>().join(separator);
        let mut more: Vec<String> = self.recipe.set.iter().flat_map(|set| ["--set".to_owned(), word(set)]).collect();
        if self.recipe.allow_outside {
            more.push("--allow-outside".to_owned());
        }
        if let Some(base) = &self.recipe.base {
            more.extend(["--base".to_owned(), word(&base.to_string_lossy())]);
        }
        let sets: String = more.iter().map(|word| format!("{separator}{word}")).collect();
        let values = [
            // Comments of one line each.
            ("name", header.name.replace(char::is_control, " ")),
            ("job", job_name(&header.name)),
            ("frames", frames.to_string()),
            ("shards", self.shards.to_string()),
            ("last", (self.shards - 1).to_string()),
            ("cpus", self.cpus.to_string()),
            ("memory", self.memory.clone()),
            ("time", self.time.clone()),
            ("image", json(&self.image)),
            ("claim", json(&self.claim)),
            ("recipe", recipe),
            ("dir", quote(&folder)),
            ("joblog", quote(&format!("{folder}.joblog"))),
            ("sets", sets),
        ];
        let script = fill(template, &values);
        say!("{}", script.trim_end());
        if u64::from(self.shards) > frames as u64 {
            eprintln!("note: {} shards for {frames} frames: some will have nothing to do", self.shards);
        }
        Ok(Code::Done)
    }
}

/// A template with every `{{name}}` replaced in one pass, so that a value cannot name another.
fn fill(template: &str, values: &[(&str, String)]) -> String {
    let mut script = String::with_capacity(template.len());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        script.push_str(before);
        let (name, after) = after.split_once("}}").expect("templates close their braces");
        let (_, value) = values.iter().find(|(key, _)| *key == name).expect("templates name known values");
        script.push_str(value);
        rest = after;
    }
    script + rest
}

/// A name that every engine takes: lower case, digits and hyphens.
fn job_name(name: &str) -> String {
    let plain: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).take(50).collect();
    let plain = plain.trim_matches('-');
    if plain.is_empty() { "ensonify".to_owned() } else { plain.to_owned() }
}

/// A word of a shell's command.
fn shell(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,@%+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// A text of JSON, YAML or Python.
fn json(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_filled_in_once() {
        assert_eq!(fill("a {{x}} {y} {{x}}.", &[("x", "{{x}}".into())]), "a {{x}} {y} {{x}}.");
    }

    #[test]
    fn words_survive_the_shell() {
        for word in ["plain/path-1.yaml", "with space", "it's", "$(rm)", "", "a;b"] {
            let output = std::process::Command::new("sh").arg("-c").arg(format!("printf %s {}", shell(word))).output();
            if let Ok(output) = output {
                assert_eq!(String::from_utf8_lossy(&output.stdout), word);
            }
        }
        assert_eq!(job_name("Bay Survey_2!"), "bay-survey-2");
    }
}
