# SPDX-License-Identifier: BSD-3-Clause
"""Writes a folder's depth images as a bag, by ROS 1's own rosbag: write_bag.py FOLDER BAG ENCODING COMPRESSION [--killed]

ENCODING: 32FC1 or 16UC1; COMPRESSION: none, lz4 or bz2. With --killed the recorder ends before it has closed the bag.
"""
import argparse
import json
import os
import pathlib
import struct

import rosbag
import rospy
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import String

# Of what is recorded beside the images no message may be taken for one.
OTHER = '/chatter'
DEPTH = '/camera/depth/image_rect_raw'
INFO = '/camera/depth/camera_info'
# A few images each, so that there are many.
CHUNK_BYTES = 200_000


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('bag')
    parser.add_argument('encoding', choices=('32FC1', '16UC1'))
    parser.add_argument('compression', choices=('none', 'lz4', 'bz2'))
    parser.add_argument('--killed', action='store_true')
    return parser.parse_args()


def stamps_of(folder):
    for line in (folder / 'data.txt').read_text().splitlines():
        number, stamp = line.split()
        seconds, nanoseconds = stamp.split('.')
        yield number, rospy.Time(int(seconds), int(nanoseconds))


def set_header(message, stamp, number):
    message.header.stamp = stamp
    message.header.frame_id = 'camera_depth_optical_frame'
    message.header.seq = int(number)


def image_of(path, encoding):
    content = path.read_bytes()
    image = Image(encoding=encoding)
    image.width, image.height = struct.unpack_from('<QQ', content)
    image.data = content[16:]
    if encoding == '16UC1':
        metres = struct.unpack_from(f'<{image.width * image.height}f', content, 16)
        image.data = struct.pack(f'<{len(metres)}H', *(int(1000 * z + 0.5) for z in metres))
    image.step = len(image.data) // image.height
    return image


def info_of(folder):
    camera = json.loads((folder / 'cam_K.json').read_text())
    fx, fy, cx, cy = (camera[name] for name in ('fx', 'fy', 'cx', 'cy'))
    info = CameraInfo(width=camera['width'], height=camera['height'], distortion_model='plumb_bob')
    info.D = [0.0] * 5
    info.K = [fx, 0, cx, 0, fy, cy, 0, 0, 1]
    info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    info.P = [fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0]
    return info


def write(bag, folder, encoding):
    info = info_of(folder)
    for number, stamp in stamps_of(folder):
        image = image_of(folder / 'depth' / f'{number}.float', encoding)
        set_header(image, stamp, number)
        set_header(info, stamp, number)
        bag.write(OTHER, String('a talker'), stamp)
        bag.write(INFO, info, stamp)
        bag.write(DEPTH, image, stamp)


def check(path, compression):
    """That most chunks are packed as was asked for."""
    with rosbag.Bag(path) as bag:
        found = bag.get_compression_info().compression
    if found != compression:
        raise SystemExit(f'{path} is packed by {found}')


def main():
    options = parse()
    bag = rosbag.Bag(options.bag, 'w', compression=options.compression, chunk_threshold=CHUNK_BYTES)
    write(bag, options.folder, options.encoding)
    if options.killed:
        bag.flush()
        os._exit(0)
    bag.close()
    check(options.bag, options.compression)


if __name__ == '__main__':
    main()
