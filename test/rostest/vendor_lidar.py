#!/usr/bin/python3
"""Plays the driver of a lidar whose vendor knows nothing of this package: what it sees, on a topic and in a frame of its choice."""

import rospy
from sensor_msgs.msg import LaserScan


def send(scan):
    scan.header.frame_id = "laser_link"
    scans.publish(scan)


if __name__ == "__main__":
    rospy.init_node("vendor_lidar")
    scans = rospy.Publisher("vendor_scan", LaserScan, queue_size=20, tcp_nodelay=True)
    rospy.Subscriber("/light", LaserScan, send, tcp_nodelay=True)
    rospy.spin()
