//! Hostile texts end in an error with a place or in numbers: never in a panic, an overflow of the
//! stack, a loop without end or unbounded memory.

use std::sync::mpsc;
use std::time::{Duration, Instant};

use ppum_testkit::corpus::hostile::{
    Arena, ParseOutcome, STACK, Seed, mutant, seeds, survive, valid_seeds,
};
use ppum_testkit::random::Random;

/// The longest time for one text. Only a text that never ends takes it; the slowest takes about
/// a second.
const TIME_LIMIT: Duration = Duration::from_secs(300);

/// Runs texts on a small stack, one after the other; counts their fates. Each text must end
/// in time.
fn run(texts: impl Iterator<Item = (String, String)> + Send + 'static, seed: u64) -> [usize; 3] {
    let (report, reports) = mpsc::channel();
    let work = move || {
        let (arena, mut random) = (Arena::new(), Random(seed));
        for (name, text) in texts {
            let start = Instant::now();
            // nobody listens any more when the test has failed
            let _ = report.send(Err(name));
            let fate = survive(&text, &arena, &mut random);
            let _ = report.send(Ok((fate, start.elapsed())));
        }
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(work).expect("a thread");
    let (mut fates, mut current, mut slowest) = ([0; 3], String::new(), Duration::ZERO);
    loop {
        match reports.recv_timeout(TIME_LIMIT) {
            Ok(Err(name)) => current = name,
            Ok(Ok((fate, time))) => {
                fates[fate.unwrap_or_else(|what| panic!("{current}: {what}")) as usize] += 1;
                if time > slowest {
                    slowest = time;
                    println!("{:.2} s: {}", time.as_secs_f64(), shortened(&current));
                }
            }
            Err(mpsc::RecvTimeoutError::Timeout) => panic!("does not end: {current}"),
            Err(mpsc::RecvTimeoutError::Disconnected) => break,
        }
    }
    assert!(thread.join().is_ok(), "panicked: {current}");
    fates
}

fn shortened(text: &str) -> String {
    text.chars().take(100).collect()
}

#[test]
fn kept_texts() {
    let kept: Vec<Seed> = seeds();
    assert!(kept.len() >= 300, "{} texts", kept.len());
    let count = kept.len();
    let fates = run(kept.into_iter().map(|seed| (seed.name, seed.text)), 1);
    println!("refused, too large, evaluated: {fates:?}");
    assert_eq!(fates.iter().sum::<usize>(), count);
    assert!(
        fates[ParseOutcome::Refused as usize] >= 150
            && fates[ParseOutcome::Evaluated as usize] >= 100
    );
}

/// A fixed number of mutants, the same ones every time.
#[test]
fn mutants() {
    const COUNT: usize = 10_000;
    let short = |seed: &Seed| seed.text.len() < 2_000;
    let mut from: Vec<Seed> = seeds().into_iter().filter(short).collect();
    from.extend(valid_seeds());
    let mut random = Random(20_111);
    let texts =
        (0..COUNT).map(move |_| mutant(&from, &mut random)).map(|text| (text.clone(), text));
    let fates = run(texts, 2);
    println!("refused, too large, evaluated: {fates:?}");
    assert_eq!(fates.iter().sum::<usize>(), COUNT);
    assert!(fates[ParseOutcome::Evaluated as usize] > COUNT / 5, "{fates:?}");
}
