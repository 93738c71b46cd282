//! Time of one computation of each kind that users wait for, on one thread: the lines of the table in docs/charts.md.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use creepage_validation::computations;

fn aims(criterion: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let mut group = criterion.benchmark_group("aims");
    group.sample_size(10);
    for aim in computations::aims().expect("scenes that can be read") {
        group.throughput(Throughput::Elements(aim.of as u64));
        group.bench_function(aim.name, |bencher| {
            bencher.iter(|| one.install(|| (aim.work)()).expect("an answer"));
        });
    }
    group.finish();
}

criterion_group!(benches, aims);
criterion_main!(benches);
