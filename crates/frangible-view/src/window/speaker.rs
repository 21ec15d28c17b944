//! Audio output on desktops: the PulseAudio protocol on Linux, which PipeWire also supports, and the native API elsewhere.

use frangible_sound::Outlet;

/// Plays the samples in its outlet for as long as it lives.
pub(super) struct Speaker {
    #[cfg(target_os = "linux")]
    _stream: (pulseaudio::Client, pulseaudio::PlaybackStream),
    #[cfg(any(target_os = "windows", target_os = "macos"))]
    _stream: cpal::Stream,
}

/// The loudspeaker that other programs use, and its outlet.
///
/// # Errors
/// The reason that there is none, in words.
#[cfg(target_os = "linux")]
pub(super) fn open() -> Result<(Speaker, Outlet), String> {
    use pulseaudio::protocol::stream::{BufferAttr, StreamFlags};
    use pulseaudio::protocol::{
        ChannelMap, ChannelVolume, DEFAULT_SINK, PlaybackStreamParams, SampleFormat, SampleSpec,
    };
    use pulseaudio::{AsPlaybackSource, Client};

    /// The server makes another rate of it where the device has one.
    const RATE: u32 = 48_000;
    const BYTES: usize = size_of::<f32>();
    /// Sound that the server holds, s: more takes longer to be heard, and less makes gaps where the machine is busy.
    const HELD: f64 = 0.08;

    let told = |error: pulseaudio::ClientError| {
        format!("neither PulseAudio nor PipeWire is available ({error})")
    };
    let outlet = Outlet::new(f64::from(RATE));
    let source = outlet.clone();
    let mut samples = Vec::new();
    let fill = move |bytes: &mut [u8]| {
        samples.resize(bytes.len() / BYTES, 0.0);
        source.play(&mut samples);
        for (to, sample) in bytes.chunks_exact_mut(BYTES).zip(&samples) {
            to.copy_from_slice(&sample.to_le_bytes());
        }
        samples.len() * BYTES
    };
    let params = PlaybackStreamParams {
        sample_spec: SampleSpec {
            format: SampleFormat::Float32Le,
            channels: 2,
            sample_rate: RATE,
        },
        channel_map: ChannelMap::stereo(),
        cvolume: Some(ChannelVolume::norm(2)),
        sink_name: Some(DEFAULT_SINK.to_owned()),
        buffer_attr: BufferAttr {
            target_length: (2.0 * f64::from(RATE) * HELD) as u32 * BYTES as u32,
            ..BufferAttr::default()
        },
        flags: StreamFlags {
            adjust_latency: true,
            ..StreamFlags::default()
        },
        ..PlaybackStreamParams::default()
    };
    let client = Client::from_env(c"Frangible").map_err(told)?;
    let stream = client.create_playback_stream(params, fill.as_playback_source());
    let stream = pollster::block_on(stream).map_err(told)?;
    let speaker = Speaker {
        _stream: (client, stream),
    };
    Ok((speaker, outlet))
}

/// The loudspeaker that other programs use, and its outlet.
///
/// # Errors
/// The reason that there is none, in words.
#[cfg(any(target_os = "windows", target_os = "macos"))]
pub(super) fn open() -> Result<(Speaker, Outlet), String> {
    use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};

    let device = cpal::default_host().default_output_device();
    let device = device.ok_or("no sound device was found")?;
    let told = |error: cpal::Error| format!("the sound device cannot play ({error})");
    let mut config = device.default_output_config().map_err(told)?.config();
    config.channels = 2;
    let outlet = Outlet::new(f64::from(config.sample_rate));
    let source = outlet.clone();
    let fill = move |samples: &mut [f32], _: &cpal::OutputCallbackInfo| source.play(samples);
    // Later errors are audible.
    let stream = device.build_output_stream(config, fill, |_| {}, None);
    let stream = stream.map_err(told)?;
    stream.play().map_err(told)?;
    Ok((Speaker { _stream: stream }, outlet))
}

/// None yet.
///
/// # Errors
/// Always.
#[cfg(not(any(target_os = "linux", target_os = "windows", target_os = "macos")))]
pub(super) fn open() -> Result<(Speaker, Outlet), String> {
    Err("sound is not yet supported on this system".into())
}
