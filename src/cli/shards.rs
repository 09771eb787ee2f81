//! Which shard a process is: as it is told, else from the environment of an array job.

use anyhow::{Context as _, bail};
use clap::Args;

use crate::store::Shard;

/// A part of a dataset on the command line.
#[derive(Debug, Args)]
pub(super) struct ShardArgs {
    /// Render only part I of N, from 0; `finish` puts the parts together [default: from the environment of an array job]
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// How many parts there are, where an array job tells its number only
    #[arg(long, value_name = "N", conflicts_with = "shard")]
    shards: Option<u32>,
}

/// Variables of a kind of array job.
struct Engine {
    name: &'static str,
    /// Number of the task.
    task: &'static str,
    /// Number of the first task, where it need not be 0.
    first: Option<&'static str>,
    /// How many tasks there are, where the engine tells.
    count: Option<&'static str>,
}

/// Slurm's sbatch(1) "OUTPUT ENVIRONMENT VARIABLES"; Kubernetes' "Indexed Job"; "AWS Batch job environment variables".
const ENGINES: [Engine; 3] = [
    Engine {
        name: "Slurm",
        task: "SLURM_ARRAY_TASK_ID",
        first: Some("SLURM_ARRAY_TASK_MIN"),
        count: Some("SLURM_ARRAY_TASK_COUNT"),
    },
    Engine { name: "Kubernetes", task: "JOB_COMPLETION_INDEX", first: None, count: None },
    Engine {
        name: "AWS Batch",
        task: "AWS_BATCH_JOB_ARRAY_INDEX",
        first: None,
        count: Some("AWS_BATCH_JOB_ARRAY_SIZE"),
    },
];

impl ShardArgs {
    /// The shard, and where it was found if nobody told.
    pub fn shard(&self) -> anyhow::Result<(Shard, Option<String>)> {
        self.shard_from(&|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
    }

    fn shard_from(&self, variable: &dyn Fn(&str) -> Option<String>) -> anyhow::Result<(Shard, Option<String>)> {
        if let Some(shard) = self.shard {
            return Ok((shard, None));
        }
        let number = |name: &str| -> anyhow::Result<Option<u32>> {
            let read = |text: String| text.parse().with_context(|| format!("{name} is `{text}`, which is no number"));
            variable(name).map(read).transpose()
        };
        for Engine { name, task, first, count } in ENGINES {
            let Some(id) = number(task)? else { continue };
            let first = first.map(number).transpose()?.flatten().unwrap_or(0);
            let Some(count) =
                self.shards.map_or_else(|| Ok(count.map(number).transpose()?.flatten()), |n| anyhow::Ok(Some(n)))?
            else {
                bail!("this is task {id} of a {name} array, which does not tell how many there are; add --shards N");
            };
            let Some(index) = id.checked_sub(first).filter(|&index| index < count) else {
                bail!(
                    "{task} is {id}, but the {name} array has {count} tasks from {first}: an array with gaps names no \
                     shards; write --shard I/N"
                );
            };
            let shard = format!("{index}/{count}").parse()?;
            return Ok((shard, Some(format!("{task}={id} of a {name} array"))));
        }
        match self.shards {
            None | Some(1) => Ok((Shard::WHOLE, None)),
            Some(count) => bail!("--shards {count} is for array jobs, and this is none; write --shard 0/{count}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shard(args: &[&str], variables: &[(&str, &str)]) -> anyhow::Result<(Shard, Option<String>)> {
        #[derive(clap::Parser)]
        struct Line {
            #[command(flatten)]
            shard: ShardArgs,
        }
        let line = <Line as clap::Parser>::parse_from(std::iter::once(&"run").chain(args));
        let find = |name: &str| variables.iter().find(|(key, _)| *key == name).map(|(_, value)| (*value).to_owned());
        line.shard.shard_from(&find)
    }

    #[test]
    fn array_jobs_name_their_shards() {
        let slurm = [("SLURM_ARRAY_TASK_ID", "5"), ("SLURM_ARRAY_TASK_MIN", "1"), ("SLURM_ARRAY_TASK_COUNT", "8")];
        let (found, told) = shard(&[], &slurm).unwrap();
        assert_eq!(
            (found, told.unwrap().as_str()),
            (Shard { index: 4, count: 8 }, "SLURM_ARRAY_TASK_ID=5 of a Slurm array")
        );
        let kubernetes = [("JOB_COMPLETION_INDEX", "0")];
        assert_eq!(shard(&["--shards", "3"], &kubernetes).unwrap().0, Shard { index: 0, count: 3 });
        let batch = [("AWS_BATCH_JOB_ARRAY_INDEX", "2"), ("AWS_BATCH_JOB_ARRAY_SIZE", "4")];
        assert_eq!(shard(&[], &batch).unwrap().0, Shard { index: 2, count: 4 });
        assert_eq!(shard(&["--shard", "0/2"], &batch).unwrap(), (Shard { index: 0, count: 2 }, None), "told is told");
        assert_eq!(shard(&[], &[]).unwrap(), (Shard::WHOLE, None));
    }

    #[test]
    fn what_cannot_be_a_shard_is_refused() {
        let message = |args: &[&str], variables: &[(&str, &str)]| shard(args, variables).unwrap_err().to_string();
        assert!(message(&[], &[("JOB_COMPLETION_INDEX", "0")]).contains("--shards N"));
        let gaps = [("SLURM_ARRAY_TASK_ID", "9"), ("SLURM_ARRAY_TASK_MIN", "3"), ("SLURM_ARRAY_TASK_COUNT", "2")];
        assert!(message(&[], &gaps).contains("--shard I/N"));
        assert!(message(&[], &[("SLURM_ARRAY_TASK_ID", "x")]).contains("no number"));
        assert!(message(&["--shards", "2"], &[]).contains("--shard 0/2"));
    }
}
