//! Reading a million rows of deflections, 29 columns each.
#![allow(missing_docs, reason = "the macros of criterion make public items")]

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use hexbench_core::files::read_measurements_from;
use std::fmt::Write;
use std::hint::black_box;

const ROWS: u32 = 1_000_000;

const HEADER: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
    ref_fx_N,ref_fy_N,ref_fz_N,ref_mx_Nm,ref_my_Nm,ref_mz_Nm,approach,delta_T_K,elapsed_s,\
    da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad\n";

fn table() -> String {
    let mut text = HEADER.to_owned();
    for row in 0..ROWS {
        let x = f64::from(row) * 1.234_567e-5;
        let _ = writeln!(
            text,
            "{row},1,{:.7},4.45357774,0.586307376,-7.89776734,0.804678281,7.49341492,0,0,-338.445,0,0,0,\
             0,0,-119.682,0,0,0,1,0.0535093,76.907,{x:.6},2.258449,-13.110664,-18.498588,18.372970,61.832877",
            27.0 - x
        );
    }
    text
}

fn a_million_rows(bench: &mut Criterion) {
    let text = table();
    let mut group = bench.benchmark_group("read_measurements");
    group.sample_size(10).throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("a million rows", |bencher| {
        let read =
            |text: &str| read_measurements_from(text.as_bytes(), "bench").map(|reading| reading.warnings);
        bencher.iter_batched(|| text.as_str(), |text| black_box(read(text).is_ok()), BatchSize::PerIteration);
    });
    group.finish();
}

criterion_group!(benches, a_million_rows);
criterion_main!(benches);
