//! `londra breed`: puppies and random dogs, as breed files.

use super::args::Breed as Args;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::anatomy::{Breed, Locks, Space, cross, save_breed};
use crate::app::disk::write_atomic;
use crate::math::rng::Rng;
use crate::measure::Folds;
use crate::rig::Rig;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How often a dog is drawn again whose skin would fold. One random dog in eight is such a dog, a puppy hardly ever.
const MOST_DRAWS: u32 = 100;

/// Makes the dogs, writes their files, prints the paths.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if let Some(target) = &args.output {
        output::check_target(target, args.report.json)?;
    }
    let rigs = Rigs::open()?;
    let dogs = match (&args.parents[..], args.litter, args.random) {
        ([], None, Some(n)) => random(args, &rigs, n)?,
        ([sire, dam], Some(n), None) => litter(args, &rigs, [sire, dam], n)?,
        ([_, _], None, None) => return Err(Failure::Use("say how many puppies, such as --litter 6".into())),
        ([], _, None) => {
            return Err(Failure::Use(
                "say two parents and --litter N, such as 'londra breed pug borzoi --litter 6 -o puppies', or --random"
                    .into(),
            ));
        }
        (parents, ..) => {
            let n = parents.len();
            return Err(Failure::Use(format!("a litter has two parents, not {n}: londra breed A B --litter 6")));
        }
    };
    // Nothing is written before every dog is made and every place is known to be right.
    let paths = args.output.as_deref().map(|target| places(target, &dogs)).transpose()?;
    if let Some(folder) = args.output.as_deref().filter(|target| paths.iter().flatten().any(|path| path != target)) {
        make_folder(folder)?;
    }
    for (path, dog) in paths.iter().flatten().zip(&dogs) {
        let text = save_breed(&rigs.table, dog);
        if output::is_stdout(path) {
            return output::result(text.trim_end());
        }
        write_atomic(path, text.as_bytes())?;
        if !args.report.json {
            output::result(&path.display().to_string())?;
        }
    }
    if args.report.json {
        let paths = paths.unwrap_or_default();
        let facts = dogs.iter().enumerate().map(|(i, dog)| as_json(&rigs, dog, paths.get(i)));
        output::json(&facts.collect())?;
    }
    Ok(())
}

fn random(args: &Args, rigs: &Rigs, n: u32) -> Result<Vec<Breed>, Failure> {
    let breeds = rigs.ids().iter().map(|id| rigs.breed(id)).collect::<Result<Vec<_>, _>>()?;
    let space = Space::new(&rigs.table, &breeds).map_err(Failure::work)?;
    let base = match &args.base {
        Some(word) => rigs.breed(word)?,
        None if args.lock.is_empty() => space.mean(&rigs.table),
        None => return Err(Failure::Use("--lock keeps the values of a dog: name it with --base".into())),
    };
    let (base, locks) = kept(args, rigs, base)?;
    let dog = |k: u32, rng: &mut Rng| {
        let mut dog = space.random(&rigs.table, &breeds, &base, &locks, rng);
        dog.id = format!("random_{}_{k}", args.seed);
        dog.label = format!("Random {}-{k}", args.seed);
        Ok(dog)
    };
    each(rigs, args.seed, n, dog)
}

fn litter(args: &Args, rigs: &Rigs, parents: [&str; 2], n: u32) -> Result<Vec<Breed>, Failure> {
    let [sire, dam] = [rigs.breed(parents[0])?, rigs.breed(parents[1])?];
    let base = match &args.base {
        Some(word) => rigs.breed(word)?,
        None => sire.clone(),
    };
    let (base, locks) = kept(args, rigs, base)?;
    let puppy = |k: u32, rng: &mut Rng| {
        let mut puppy = cross(&rigs.table, &sire, &dam, rng).map_err(Failure::work)?;
        locks.hold(&base, &mut puppy);
        puppy.id = format!("{}_x_{}_{k}", sire.id, dam.id);
        puppy.label = format!("{} x {} {k}", sire.label, dam.label);
        Ok(puppy)
    };
    each(rigs, args.seed, n, puppy)
}

/// Dogs 1 to n, each from a stream of its own: the third is the same in any number of dogs. A dog whose skin would fold
/// onto itself is drawn again.
fn each(
    rigs: &Rigs,
    seed: u64,
    n: u32,
    dog: impl Fn(u32, &mut Rng) -> Result<Breed, Failure>,
) -> Result<Vec<Breed>, Failure> {
    let rig = Rig::embedded(&rigs.table).map_err(Failure::work)?;
    let mut folds = Folds::new(Arc::new(rig)).map_err(Failure::work)?;
    let mut seeds = Rng::new(seed);
    let mut one = |k: u32| {
        let mut rng = Rng::new(seeds.next_u64());
        let (dog, is_unfolded) = folds.unfolded(MOST_DRAWS, || dog(k, &mut rng))?;
        if !is_unfolded {
            output::message(&format!("{}: its skin folds onto itself, as that of others drawn in its place", dog.id));
        }
        Ok(dog)
    };
    (1..=n).map(&mut one).collect()
}

/// The dog whose values are kept, after `--set`, and what is kept of it.
fn kept(args: &Args, rigs: &Rigs, mut base: Breed) -> Result<(Breed, Locks), Failure> {
    let mut locks = Locks::none(&rigs.table);
    for word in &args.lock {
        locks.lock(&rigs.table, word).map_err(|error| Failure::Use(error.to_string()))?;
    }
    for setting in &args.set {
        locks.lock_row(subject::set(&rigs.table, &mut base, &setting.id, setting.value)?);
    }
    Ok((base, locks))
}

/// Where each dog goes: into a folder under its id, or the only one to a file.
fn places(target: &Path, dogs: &[Breed]) -> Result<Vec<PathBuf>, Failure> {
    let is_file = output::is_stdout(target) || target.extension().is_some_and(|e| e == "ron");
    if is_file && dogs.len() == 1 {
        return Ok(vec![target.to_owned()]);
    }
    if is_file {
        let (n, target) = (dogs.len(), target.display());
        return Err(Failure::Use(format!("{n} dogs are {n} files: -o {target} should be a folder")));
    }
    if target.exists() && !target.is_dir() {
        return Err(Failure::work(format!("{}: is no folder; name another with -o", target.display())));
    }
    Ok(dogs.iter().map(|dog| target.join(format!("{}.ron", dog.id))).collect())
}

/// Makes a folder where there is none yet; the one that it stands in must be there.
fn make_folder(folder: &Path) -> Result<(), Failure> {
    if folder.is_dir() {
        return Ok(());
    }
    std::fs::create_dir(folder)
        .map_err(|error| Failure::work(format!("{}: the folder cannot be made: {error}", folder.display())))
}

/// Values in the units of files, by id.
fn as_json(rigs: &Rigs, dog: &Breed, path: Option<&PathBuf>) -> Value {
    let specs = rigs.table.specs.iter().zip(&dog.values);
    let values: Map<String, Value> = specs.map(|(spec, &si)| (spec.id.clone(), json!(spec.from_si(si)))).collect();
    let path = path.map(|p| p.display().to_string());
    json!({ "id": dog.id, "label": dog.label, "output": path, "values": values })
}
